// Readers of mesh formats that are XML, alone or in a zip archive. Without libzip and pugixml they report that.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// 3MF: the objects that are built, in place; materials and colours as far as triangles have one.
std::optional<Mesh> read_3mf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// AMF as text or zipped; curved edges are taken as straight.
std::optional<Mesh> read_amf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats

// Readers of mesh formats based on XML, alone or in a zip archive. In builds without libzip and pugixml they only
// report that.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// Reads 3MF: the objects that are built, placed; materials and colours as far as whole triangles have them.
std::optional<Mesh> read_3mf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);
// Reads AMF as text or zipped; curved edges are treated as straight.
std::optional<Mesh> read_amf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats

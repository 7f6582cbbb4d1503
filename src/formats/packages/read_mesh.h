// Reads a mesh file of any format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// Reads a file with the reader chosen by its content, or by its extension otherwise. Throws Error if the file cannot be
// read. Returns null, with the reason in the diagnostics, if it holds no mesh.
std::optional<Mesh> read_mesh(const std::string& path, Diagnostics& diagnostics);
// Reads bytes in memory; `name` is used in messages, and for its extension.
std::optional<Mesh> read_mesh(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats

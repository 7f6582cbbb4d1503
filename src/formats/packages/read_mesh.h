// Reads a mesh file of any format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// Chooses the reader by the file's content, else by its extension. Throws Error if the file cannot be
// read. Nothing is returned, and the reason is in the diagnostics, if it holds no mesh.
std::optional<Mesh> read_mesh(const std::string& path, Diagnostics& diagnostics);
// Reads bytes in memory; `name` is for messages and for its extension.
std::optional<Mesh> read_mesh(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats

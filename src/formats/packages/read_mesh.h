// Reads a mesh file of any format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/mesh/files_beside.h"
#include "formats/mesh/mesh.h"

namespace ombre::formats {

// Reads a file, and those beside it that hold parts of it, with the reader chosen by its content, or by its extension
// otherwise. Throws Error if a file cannot be read. Returns null, with the reason in the diagnostics, if it holds no
// mesh.
std::optional<Mesh> read_mesh(const std::string& path, Diagnostics& diagnostics);
// Reads bytes in memory; `name` is used in messages, and for its extension.
std::optional<Mesh> read_mesh(const std::string& name, std::string_view bytes, Diagnostics& diagnostics,
                              const FilesBeside& files = {});

// Returns what tells which files beside a mesh file of this name its triangles need, as paths relative to its folder;
// null for formats that need none.
using NamesOfFiles = std::vector<std::string> (*)(const std::string& name, std::string_view bytes);
NamesOfFiles files_of_mesh(const std::string& path);

}  // namespace ombre::formats

// Lists the files that a design consists of.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "base/text/diagnostic.h"
#include "load/loaded.h"

namespace ombre::compile {

// Returns the absolute paths of the files that loading a design reads: the design, its includes, meshes, pictures,
// tables and materials. Returns nothing, and adds diagnostics, when the design is wrong.
std::optional<std::set<std::filesystem::path>> files_read(const std::string& path, const LoadOptions& options,
                                                          Diagnostics& diagnostics);

}  // namespace ombre::compile

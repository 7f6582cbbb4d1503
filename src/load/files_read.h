// The files that a design consists of.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "base/text/diagnostic.h"
#include "load/loaded.h"

namespace ombre::compile {

// A file's whole path, without links in its folders: a link to a file stays where the design sees it.
std::filesystem::path whole_path(const std::filesystem::path& file);

// The files that loading a design reads, by their whole paths: itself, what it includes, meshes, pictures, tables and
// materials. Nothing, and diagnostics, when the design is wrong.
std::optional<std::set<std::filesystem::path>> files_read(const std::string& path, const LoadOptions& options,
                                                          Diagnostics& diagnostics);

}  // namespace ombre::compile

// Loads designs of any language.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"
#include "base/text/error.h"
#include "load/loaded.h"

namespace ombre::compile {

// Loads a design. Returns null, and adds diagnostics, when it is wrong. Throws Error for files that cannot be read.
LoadedPtr load_design(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

// Loads a design from a text instead of a file. The ending of `path` says the language, and relative paths in the
// design begin in its folder.
LoadedPtr load_text(std::string text, const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

// Loads the materials file at `path`, or the default set if it is empty.
std::optional<design::MaterialTable> load_materials(const std::string& path, Diagnostics& diagnostics);

}  // namespace ombre::compile

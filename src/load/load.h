// Loads designs of any language.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"
#include "base/text/error.h"
#include "load/loaded.h"

namespace ombre::compile {

// Null, and diagnostics, when the design is wrong. Throws Error for files that cannot be read.
LoadedPtr load_design(const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

// The same of a design that is no file. `path` is the one that it would have: its ending says the language, and
// relative paths in the design begin in its folder.
LoadedPtr load_text(std::string text, const std::string& path, const LoadOptions& options, Diagnostics& diagnostics);

// The materials file at `path`, or the default set when it is empty.
std::optional<design::MaterialTable> load_materials(const std::string& path, Diagnostics& diagnostics);

}  // namespace ombre::compile

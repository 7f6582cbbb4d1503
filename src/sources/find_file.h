// Finds the files that designs name.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"

namespace ombre::sources {

// Returns the path of a file. It is searched for beside the script, then beside the script's link target, then in the
// working directory. Null, with a diagnostic, if it does not exist.
std::optional<std::string> find_file(const std::string& path, const SourceRange& where, Diagnostics& diagnostics);

}  // namespace ombre::sources

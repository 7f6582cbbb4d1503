// Where the files are that designs name.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"

namespace ombre::sources {

// Where the path leads: beside the script first, then beside what it links to, then in the working directory. Nothing,
// and a diagnostic, when no file is there.
std::optional<std::string> find_file(const std::string& path, const SourceRange& where, Diagnostics& diagnostics);

}  // namespace ombre::sources

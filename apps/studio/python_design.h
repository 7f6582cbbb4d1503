// Designs in Python, which run in a separate process.
#pragma once

#include <string>
#include <vector>

#include "load/loaded.h"

namespace ombre::studio {

// Runs the script at `path` as stored on disk; `program` is the command line that starts Ombre. Returns null, with
// diagnostics, if it fails. What the script says goes to `options.echo` while it runs. Throws Error and Cancelled.
compile::LoadedPtr load_python(const std::string& path, const std::vector<std::string>& program,
                               const compile::LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::studio

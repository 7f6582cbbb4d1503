// Loads designs in Python by a separate process.
#pragma once

#include <string>
#include <vector>

#include "load/loaded.h"

namespace ombre::studio {

// Runs the script at `path`, as it is on the disk, by `program`, the words that start Ombre's command line. Returns
// null, and adds diagnostics, when something is wrong. Throws Error and Cancelled.
compile::LoadedPtr load_python(const std::string& path, const std::vector<std::string>& program,
                               const compile::LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::studio

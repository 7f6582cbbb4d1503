// Designs in Python, which a process of their own makes.
#pragma once

#include <string>
#include <vector>

#include "load/loaded.h"

namespace ombre::studio {

// Runs the script at `path`, as it is on the disk, by `program`, the words that start Ombre's command line. Null, and
// diagnostics, when something is wrong. Throws Error and Cancelled.
compile::LoadedPtr load_python(const std::string& path, const std::vector<std::string>& program,
                               const compile::LoadOptions& options, Diagnostics& diagnostics);

}  // namespace ombre::studio

// Scripts that show data files: scans and results of simulations.
#pragma once

#include <filesystem>
#include <string>

namespace ombre::studio {

// These functions return a `.vcad` script that shows the file at `path`, which the script calls `name`. The script for
// a scan shows the solid above a level; the script for results shows the mesh, moved by its displacement, with an
// attribute for each number. They throw Error if the file cannot be read.
std::string script_for_scan(const std::string& name, const std::filesystem::path& path);
std::string script_for_results(const std::string& name, const std::filesystem::path& path);

}  // namespace ombre::studio

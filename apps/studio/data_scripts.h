// Writes scripts that show data files: scans and results of simulations.
#pragma once

#include <filesystem>
#include <string>

namespace ombre::studio {

// Each function writes a `.vcad` script that shows the file, which the script calls `name` and which lies at `path`.
// The script for a scan shows the solid from a level on. The script for results shows the mesh, moved by its
// displacement, with an attribute for each number. They throw Error for a file that cannot be read.
std::string script_for_scan(const std::string& name, const std::filesystem::path& path);
std::string script_for_results(const std::string& name, const std::filesystem::path& path);

}  // namespace ombre::studio

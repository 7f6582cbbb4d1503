// Scripts that show data files: scans, results of simulations, models, images and drawings.
#pragma once

#include <filesystem>
#include <string>

namespace ombre::studio {

// These functions return a `.vcad` script that shows the file at `path`, which the script calls `name`. The script for
// a scan shows the solid above a level; the script for results shows the mesh, moved by its displacement, with an
// attribute for each number. They throw Error if the file cannot be read.
std::string script_for_scan(const std::string& name, const std::filesystem::path& path);
std::string script_for_results(const std::string& name, const std::filesystem::path& path);

// A design that reads one file.
struct ImportingDesign {
  std::string ending;  // of the design's name
  std::string text;
};

// Returns a design that imports the file at `path`, which the design calls `name`. Throws RequestError if no node reads
// files of that kind, and Error if the file cannot be read.
ImportingDesign importing_design(const std::string& name, const std::filesystem::path& path);

// Returns true if files of this name are imported by a design.
bool can_be_imported(const std::string& name);

}  // namespace ombre::studio

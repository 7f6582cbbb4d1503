// Printer profiles by name or by path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "voxel/printer.h"

namespace ombre::compile {

// The names of the profiles that come with Ombre, sorted. Throws Error when there is no data folder.
std::vector<std::string> printer_names();

// A name is looked up among those; what ends in ".json" or holds a '/' is a path. Nothing, and
// diagnostics, for an unknown name or a wrong profile. Throws Error for a file that cannot be read.
std::optional<voxel::Printer> find_printer(const std::string& name_or_path, Diagnostics& diagnostics);

}  // namespace ombre::compile

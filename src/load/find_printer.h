// Finds printer profiles by name or by path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "voxel/printer.h"

namespace ombre::compile {

// Returns the sorted names of the profiles that come with Ombre. Throws Error when there is no data folder.
std::vector<std::string> printer_names();

// Looks a name up among printer_names(); a text that ends in ".json" or holds a '/' is a path. Returns nothing, and
// adds diagnostics, for an unknown name or a wrong profile. Throws Error for a file that cannot be read.
std::optional<voxel::Printer> find_printer(const std::string& name_or_path, Diagnostics& diagnostics);

}  // namespace ombre::compile

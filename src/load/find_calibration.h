// Finds calibrations by name or by path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.h"

namespace ombre::compile {

// Returns the sorted names of the calibrations that come with Ombre. Throws Error when there is no data folder.
std::vector<std::string> calibration_names();

// Looks a name up among calibration_names(); a text that ends in ".json" or holds a '/' is a path. Returns null, and
// adds diagnostics, for an unknown name or a wrong calibration. Throws Error for a file that cannot be read.
calibration::CalibrationPtr find_calibration(const std::string& name_or_path, Diagnostics& diagnostics);

// Returns the names and paths that the materials file at `path` lists as "calibrations"; the default set's if it is
// empty. Paths begin in the file's folder. Returns nothing, and adds diagnostics, if they are wrong. Throws Error.
std::optional<std::vector<std::string>> calibrations_of_materials(const std::string& path, Diagnostics& diagnostics);

}  // namespace ombre::compile

// Names of files that contain volumes.
#pragma once

#include <string>

namespace ombre::formats {

// Returns true if the name has the ending of a file that `volume` reads, with whatever library: .nrrd, .nii.gz, .dcm,
// .vdb and so on.
bool has_volume_ending(const std::string& name);

}  // namespace ombre::formats

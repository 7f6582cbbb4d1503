// Names of files that hold volumes.
#pragma once

#include <string>

namespace ombre::formats {

// Does the name end like one of a file that `volume` reads, by whatever library: .nrrd, .nii.gz, .dcm, .vdb and so on?
bool has_volume_ending(const std::string& name);

}  // namespace ombre::formats

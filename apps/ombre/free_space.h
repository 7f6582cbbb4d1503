// Words about disks that are too small for what is still to be written.
#pragma once

#include <string>

namespace ombre::cli {

// Empty where the disk of `folder`, which may not exist yet, has room for so many bytes or does not tell.
std::string space_warning(const std::string& folder, double bytes);

}  // namespace ombre::cli

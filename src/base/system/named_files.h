// The places where a file that another file names may lie.
#pragma once

#include <string>
#include <vector>

namespace ombre {

// The paths to try for `path`, in their order: beside the file that names it, beside the file that this one links to,
// in the working directory. An absolute path is the only one.
std::vector<std::string> places_of(const std::string& path, const std::string& named_by);

}  // namespace ombre

// Search paths of files that are named in other files.
#pragma once

#include <string>
#include <vector>

namespace ombre {

// Returns the paths to try for `path`, in order: beside the file that names it, beside each file that this one links
// to, and in the working directory. An absolute path is returned alone.
std::vector<std::string> places_of(const std::string& path, const std::string& named_by);

}  // namespace ombre

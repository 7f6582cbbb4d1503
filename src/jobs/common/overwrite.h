// Checks the places of files that are to be written.
#pragma once

#include <string>

namespace ombre::jobs {

// Throws Error if something exists at `path`, unless it is a file and `force` is set. Also throws if its folder is
// missing or may not be written.
void refuse_to_overwrite(const std::string& path, bool force);

}  // namespace ombre::jobs

// Files that are to be written: what may lie in their places.
#pragma once

#include <string>

namespace ombre::jobs {

// Throws Error when there is something at `path`: only files are replaced, and only with `force`. The same where its
// folder is missing or may not be written.
void refuse_to_overwrite(const std::string& path, bool force);

}  // namespace ombre::jobs

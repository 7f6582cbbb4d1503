// Files that are there already.
#pragma once

#include <string>

namespace ombre::cli {

// Throws Error when there is something at `path`: only files are replaced, and only with `force`.
void refuse_to_overwrite(const std::string& path, bool force);

}  // namespace ombre::cli

// Files that are there already.
#include "ombre/overwrite.h"

#include <filesystem>

#include "base/error.h"

namespace ombre::cli {

void refuse_to_overwrite(const std::string& path, bool force) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) return;
  if (!std::filesystem::is_regular_file(status))
    throw Error(Code::cannot_write, path + " is not a file; choose another name", {{"file", path}});
  if (!force)
    throw Error(Code::exists,
                path + " exists already; replace it with " + spelled::option("--force") + ", or choose another name",
                {{"file", path}});
}

}  // namespace ombre::cli

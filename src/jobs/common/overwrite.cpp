#include "jobs/common/overwrite.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/text/error.h"
#include "export/output_file.h"
#include "jobs/common/session.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;

// Checks the folder early, since writing would otherwise fail after everything is computed.
void check_folder(const std::string& path) {
  std::error_code error;
  const fs::path folder = fs::absolute(path, error).parent_path();
  if (!error && ::access(folder.c_str(), W_OK | X_OK) != 0) throw exporting::write_error(path, errno);
}

}  // namespace

void refuse_to_overwrite(const std::string& path, bool force) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (!fs::exists(status)) return check_folder(path);
  if (!fs::is_regular_file(status))
    throw Error(Code::cannot_write, path + " is not a file; choose another name", {{"file", path}});
  if (!force)
    throw Error(Code::exists,
                path + " exists already; replace it with " + spelled::option("--force") + ", or choose another name",
                {{"file", path}});
}

void check_design_file(const std::string& path) {
  if (!path.ends_with(".json")) throw WrongArgument("-o writes a design file; give it a name that ends in .json");
}

void refuse_joined(const std::vector<std::string>& paths) {
  for (const std::string& path : paths)
    if (fs::exists(path))
      throw Error(Code::exists, path + " exists already; remove it, or plan a job with another -o", {{"file", path}});
}

}  // namespace ombre::jobs

// Where the printer profiles and materials that come with Ombre lie.
#include "compile/data_folder.h"

#include <cstdlib>
#include <filesystem>

#include "base/error.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

bool holds_data(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "printers", ignored) && fs::is_directory(folder / "materials", ignored);
}

}  // namespace

std::string data_folder() {
  if (const char* given = std::getenv("OMBRE_DATA"); given && *given) {  // NOLINT(concurrency-mt-unsafe)
    if (holds_data(given)) return given;
    throw Error(std::string("OMBRE_DATA names ") + given +
                ", which has no folders printers and materials; correct or unset it");
  }
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path installed = (program.parent_path().parent_path() / "share" / "ombre").lexically_normal();
  if (holds_data(installed)) return installed.string();
  for (fs::path folder = program.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    if (holds_data(folder)) return folder.string();
  throw Error("cannot find Ombre's printers and materials; set OMBRE_DATA to the folder that holds them");
}

}  // namespace ombre::compile

// Finds the printer profiles and materials that come with Ombre.
#include "load/data_folder.h"

#include <filesystem>

#include "base/system/environment.h"
#include "base/system/own_folders.h"
#include "base/text/error.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

bool holds_data(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "printers", ignored) && fs::is_directory(folder / "materials", ignored);
}

}  // namespace

std::string data_folder() {
  if (const std::string given = environment("OMBRE_DATA"); !given.empty()) {
    if (holds_data(given)) return given;
    throw Error(Code::file_missing,
                "OMBRE_DATA names " + given + ", which has no folders printers and materials; correct or unset it",
                {{"file", given}});
  }
  for (const fs::path& folder : own_folders())
    for (const fs::path& data : {folder / "share/ombre", folder})
      if (holds_data(data)) return data;
  throw Error(Code::file_missing,
              "cannot find Ombre's printers and materials; set OMBRE_DATA to the folder that holds them");
}

}  // namespace ombre::compile

#include "load/library_folders.h"

#include "base/system/environment.h"
#include "load/data_folder.h"

namespace ombre::compile {

namespace fs = std::filesystem;

namespace {

// Relative folders are ignored, as the base directory specification of freedesktop.org asks.
fs::path user_data() {
  const fs::path given = environment("XDG_DATA_HOME");
  if (given.is_absolute()) return given;
  const std::string home = environment("HOME");
  return home.empty() ? fs::path() : fs::path(home) / ".local/share";
}

}  // namespace

std::vector<std::string> library_folders() {
  std::vector<std::string> folders;
  if (const fs::path user = user_data(); !user.empty()) folders.push_back((user / "ombre/library").generic_string());
  for (std::string& own : own_library_folders()) folders.push_back(std::move(own));
  return folders;
}

std::vector<std::string> own_library_folders() {
  std::vector<std::string> folders;
  const fs::path data = data_folder();
  for (const fs::path& folder : {data / "library", data / "data/library"}) {
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) folders.push_back(folder.generic_string());
  }
  return folders;
}

std::optional<std::string> name_in_library(const fs::path& file) {
  for (const std::string& folder : library_folders()) {
    const std::string name = file.lexically_relative(fs::weakly_canonical(folder)).generic_string();
    if (!name.empty() && name != "." && !name.starts_with("..")) return name;
  }
  return std::nullopt;
}

}  // namespace ombre::compile

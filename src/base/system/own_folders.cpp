#include "base/system/own_folders.h"

#include <dlfcn.h>
#include <link.h>

namespace ombre {
namespace {

namespace fs = std::filesystem;

// Returns the path of the library that holds this code, or of the program if the code is part of it.
fs::path own_file() {
  std::error_code failed;
  Dl_info info{};
  link_map* loaded = nullptr;
  const bool known = dladdr1(reinterpret_cast<void*>(&own_file), &info, reinterpret_cast<void**>(&loaded),  // NOLINT
                             RTLD_DL_LINKMAP) != 0;
  const bool is_library = known && loaded && loaded->l_name && *loaded->l_name;
  fs::path file = is_library ? fs::canonical(loaded->l_name, failed) : fs::read_symlink("/proc/self/exe", failed);
  return failed ? fs::path() : file;
}

}  // namespace

std::vector<fs::path> own_folders() {
  std::vector<fs::path> folders;
  for (fs::path folder = own_file().parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    folders.push_back(folder);
  return folders;
}

}  // namespace ombre

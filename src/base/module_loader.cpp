#include "base/module_loader.h"

#include <dlfcn.h>

#include <filesystem>

#include "base/error.h"
#include "base/own_folders.h"

namespace ombre {
namespace {

namespace fs = std::filesystem;

// A wheel has it beside the library, an installed program in lib/ombre of a folder above, a build where CMake put it.
std::string found(const fs::path& built) {
  std::error_code ignored;
  const std::vector<fs::path> folders = own_folders();
  if (!folders.empty() && fs::exists(folders.front() / built.filename(), ignored))
    return folders.front() / built.filename();
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / "CMakeCache.txt", ignored)) return built;
    if (const fs::path installed = folder / "lib/ombre" / built.filename(); fs::exists(installed, ignored))
      return installed;
  }
  return built;
}

}  // namespace

void* load_symbol(const std::string& built, const char* function, const std::string& what) {
  const std::string path = found(built);
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module)
    throw Error(Code::library_missing, what + " need " + path + ", which cannot be loaded: " + dlerror());  // NOLINT
  void* const symbol = dlsym(module, function);
  if (!symbol)
    throw Error(Code::library_missing,
                what + " need " + path + ", which does not belong to this ombre: build both again");
  return symbol;
}

}  // namespace ombre

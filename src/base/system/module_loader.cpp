#include "base/system/module_loader.h"

#include <dlfcn.h>

#include <filesystem>

#include "base/system/own_folders.h"
#include "base/text/error.h"

namespace ombre {
namespace {

namespace fs = std::filesystem;

// Returns the path of the module's library, or an empty path if it is not found. It lies beside this code's library in
// a wheel, in lib/ombre of a folder above an installed program, or in modules/ of a build folder.
fs::path path_of(const Module& module) {
  const std::string file = "lib" + std::string(module.name) + ".so";
  std::error_code ignored;
  const std::vector<fs::path> folders = own_folders();
  if (!folders.empty() && fs::exists(folders.front() / file, ignored)) return folders.front() / file;
  for (const fs::path& folder : folders) {
    const char* const inside = fs::exists(folder / "CMakeCache.txt", ignored) ? "modules" : "lib/ombre";
    if (const fs::path path = folder / inside / file; fs::exists(path, ignored)) return path;
  }
  return {};
}

}  // namespace

bool has_module(const Module& module) { return !path_of(module).empty(); }

std::string without(const Module& module) {
  return std::string("this ombre was built without ") + module.library + ", which " + module.what +
         " need; ./dev build release makes it (" + module.packages + ", -D" + module.option + "=ON), or " +
         module.instead;
}

void* load_symbol(const std::string& path, const char* function, const std::string& what) {
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw Error(Code::library_missing, what + " need " + path + ", which cannot be loaded: " + dlerror());  // NOLINT
  void* const symbol = dlsym(library, function);
  if (!symbol)
    throw Error(Code::library_missing,
                what + " need " + path + ", which does not belong to this ombre: build both again");
  return symbol;
}

void* load_symbol(const Module& module, const char* function) {
  const fs::path path = path_of(module);
  if (path.empty()) throw Error(Code::library_missing, without(module));
  return load_symbol(path.string(), function, module.what);
}

}  // namespace ombre

#include "base/module_loader.h"

#include <dlfcn.h>

#include <filesystem>

#include "base/error.h"

namespace ombre {
namespace {

std::string found(const std::filesystem::path& built) {
  std::error_code ignored;
  Dl_info here{};
  if (dladdr(reinterpret_cast<void*>(&found), &here) != 0) {  // NOLINT
    const auto beside = std::filesystem::path(here.dli_fname).parent_path() / built.filename();
    if (std::filesystem::exists(beside, ignored)) return beside.string();
  }
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const auto installed = program.parent_path().parent_path() / "lib" / "ombre" / built.filename();
  return std::filesystem::exists(installed, ignored) ? installed.string() : built.string();
}

}  // namespace

void* load_symbol(const std::string& built, const char* function, const std::string& what) {
  const std::string path = found(built);
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) throw Error(what + " need " + path + ", which cannot be loaded: " + dlerror());  // NOLINT
  void* const symbol = dlsym(module, function);
  if (!symbol) throw Error(what + " need " + path + ", which does not belong to this ombre: build both again");
  return symbol;
}

}  // namespace ombre

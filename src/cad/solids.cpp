// Loads the module of CAD files when the first is read.
#include "cad/solids.h"

#include <dlfcn.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "cad/module.h"

namespace ombre::cad {
namespace {

using ReadCad = decltype(&ombre_read_cad);

#ifdef OMBRE_CAD_MODULE

// Beside this code, where it is installed, else where it was built.
std::string module_path() {
  const std::filesystem::path built = OMBRE_CAD_MODULE;
  std::error_code ignored;
  Dl_info here{};
  if (dladdr(reinterpret_cast<void*>(&module_path), &here) != 0) {  // NOLINT
    const auto beside = std::filesystem::path(here.dli_fname).parent_path() / built.filename();
    if (std::filesystem::exists(beside, ignored)) return beside.string();
  }
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const auto installed = program.parent_path().parent_path() / "lib" / "ombre" / built.filename();
  return std::filesystem::exists(installed, ignored) ? installed.string() : built.string();
}

ReadCad load_module() {
  const std::string path = module_path();
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) throw Error("CAD files need " + path + ", which cannot be loaded: " + dlerror());  // NOLINT
  return reinterpret_cast<ReadCad>(dlsym(module, "ombre_read_cad"));                              // NOLINT
}

#else

ReadCad load_module() {
  throw Error(
      "this ombre was built without Open CASCADE; install libocct-data-exchange-dev, configure with -DOMBRE_CAD=ON and "
      "build again, or save the part as a mesh (STL, 3MF)");
}

#endif

}  // namespace

bool is_cad_file(const std::string& path) {
  const std::string name = to_lower(path);
  constexpr const char* endings[] = {".step", ".stp", ".iges", ".igs"};
  return std::any_of(std::begin(endings), std::end(endings), [&](const char* e) { return name.ends_with(e); });
}

std::vector<SolidPtr> read_solids(const std::string& path) {
  static const ReadCad read = load_module();
  std::vector<SolidPtr> solids;
  read(&path, &solids);
  return solids;
}

}  // namespace ombre::cad

// Loads the module of CAD files when the first is read.
#include "cad/solids.h"

#include <algorithm>

#include "base/module_loader.h"
#include "base/text.h"
#include "cad/module.h"

namespace ombre::cad {
namespace {

#ifdef OMBRE_OPENCASCADE_MODULE
constexpr const char* opencascade_module = OMBRE_OPENCASCADE_MODULE;
#else
constexpr const char* opencascade_module = nullptr;
#endif

}  // namespace

bool is_cad_file(const std::string& path) {
  const std::string name = to_lower(path);
  constexpr const char* endings[] = {".step", ".stp", ".iges", ".igs"};
  return std::any_of(std::begin(endings), std::end(endings), [&](const char* e) { return name.ends_with(e); });
}

std::vector<SolidPtr> read_solids(const std::string& path, const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_cad)>(
      opencascade_module, "ombre_read_cad", "CAD files",
      "this ombre was built without Open CASCADE; install libocct-data-exchange-dev, configure with -DOMBRE_CAD=ON and "
      "build again, or save the part as a mesh (STL, 3MF)");
  std::vector<SolidPtr> solids;
  read(&path, stop, &solids);
  return solids;
}

}  // namespace ombre::cad

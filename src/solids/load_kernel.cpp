// Loads the module with the geometry kernel when it is first needed.
#include "solids/kernel.h"

#include "base/error.h"
#include "base/module_loader.h"
#include "solids/module.h"

namespace ombre::solids {

#ifdef OMBRE_CGAL_MODULE

bool has_kernel() { return true; }

const Kernel& kernel() {
  static const Kernel* const loaded =
      load_function<decltype(ombre_solids_kernel)>(OMBRE_CGAL_MODULE, "ombre_solids_kernel", "polyhedra")();
  return *loaded;
}

#else

bool has_kernel() { return false; }

const Kernel& kernel() {
  throw Error(
      Code::library_missing,
      "this ombre was built without CGAL, which polyhedra need; install libcgal-dev and libpolyclipping-dev, configure "
      "with -DOMBRE_SOLIDS=ON and build again");
}

#endif

}  // namespace ombre::solids

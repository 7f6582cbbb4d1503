// Loads the module that makes tetrahedra when it is first needed.
#include "solids/tetrahedra.h"

#include "base/error.h"
#include "base/module_loader.h"

namespace ombre::solids {

#ifdef OMBRE_TETRAHEDRA_MODULE

bool has_tetrahedra() { return true; }

Tetrahedra make_tetrahedra(const TetrahedraRequest& request) {
  static const auto make =
      load_function<decltype(ombre_make_tetrahedra)>(OMBRE_TETRAHEDRA_MODULE, "ombre_make_tetrahedra", "tetrahedra");
  Tetrahedra made;
  make(request, made);
  return made;
}

#else

bool has_tetrahedra() { return false; }

Tetrahedra make_tetrahedra(const TetrahedraRequest&) {
  throw Error(
      "this ombre was built without CGAL, which makes tetrahedra; install libcgal-dev, configure with "
      "-DOMBRE_SOLIDS=ON "
      "and build again, or use bricks");
}

#endif

}  // namespace ombre::solids

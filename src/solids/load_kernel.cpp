// Loads the module with the geometry kernel on first use.
#include "solids/kernel.h"

#include "base/system/module_loader.h"
#include "solids/kernel_calls.h"

namespace ombre::solids {

namespace {

constexpr Module cgal{"ombre_cgal",  "CGAL",         "polyhedra",
                      "libcgal-dev", "OMBRE_SOLIDS", "write the design without them"};

}  // namespace

bool has_kernel() { return has_module(cgal); }

std::string without_kernel() { return without(cgal); }

const Kernel& kernel() {
  static const Kernel* const loaded = load_function<decltype(ombre_solids_kernel)>(cgal, "ombre_solids_kernel")();
  return *loaded;
}

}  // namespace ombre::solids

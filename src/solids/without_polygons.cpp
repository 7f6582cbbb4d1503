// Operations on regions in builds without the polygon library: each throws Error.
#ifndef OMBRE_POLYGONS

#include "base/text/error.h"
#include "solids/regions.h"

namespace ombre::solids {
namespace {

[[noreturn]] void report() {
  throw Error(Code::library_missing,
              "this ombre was built without polyclipping, which polygons need; install libpolyclipping-dev, configure "
              "with -DOMBRE_POLYGONS=ON and build again");
}

}  // namespace

Region region_of(std::span<const Ring>) { report(); }
Region wound_region_of(std::span<const Ring>) { report(); }
Region unite(std::span<const Region>) { report(); }
Region intersect(const Region&, const Region&) { report(); }
Region subtract(const Region&, const Region&) { report(); }
Region moved(const Region&, const Affine&) { report(); }
Region offset(const Region&, const Offset&) { report(); }
Region cleaned(const Region&, double) { report(); }
Region fill(const Region&) { report(); }
Region hull(std::span<const Region>) { report(); }
Region minkowski(const Region&, const Region&) { report(); }

}  // namespace ombre::solids

#endif

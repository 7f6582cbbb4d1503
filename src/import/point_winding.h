// How often a mesh winds around a point.
#pragma once

#include "import/dyadic_bins.h"
#include "import/surface.h"

namespace ombre::importing {

// By a ray along -x, with the arithmetic of RowWinding: at integer points the two agree exactly.
class PointWinding {
 public:
  explicit PointWinding(SurfacePtr surface);

  // Exact for closed meshes; 0 for points that are not finite.
  int64_t at(Vec3 p) const;

 private:
  SurfacePtr surface_;
  DyadicBins by_yz_;
};

}  // namespace ombre::importing

// How often a mesh winds around a point.
#pragma once

#include "import/fields/dyadic_bins.h"
#include "import/fields/ray_crossings.h"
#include "import/surfaces/surface.h"

namespace ombre::importing {

// By a ray along -x, with the arithmetic of RowWinding: at integer points the two agree exactly.
class PointWinding {
 public:
  explicit PointWinding(SurfacePtr surface);

  // Exact for closed meshes; 0 for points that are not finite.
  int64_t at(Vec3 p) const;

  // Where the ray crosses a triangle, and which way: 1 or -1, or 0 where it misses it.
  struct Crossing {
    int way = 0;
    double x = 0;
  };
  Crossing crossing(uint32_t triangle, Vec3 p) const {
    if (!reaches_[triangle].meets(p)) return {};
    const auto segment = slice(surface_->corners(triangle), p.z);
    if (!segment) return {};
    const int way = winding(*segment, p.y);
    if (way == 0) return {};
    const double x = cross_row(*segment, p.y);
    return x <= p.x ? Crossing{way, x} : Crossing{};
  }
  const Surface& surface() const { return *surface_; }

 private:
  // What a ray must meet to cross a triangle: this little memory rules out most of those in its bins.
  struct Reach {
    float least_x, least_y, most_y, least_z, most_z;
    bool meets(Vec3 p) const {
      return least_x <= p.x && least_y <= p.y && p.y <= most_y && least_z <= p.z && p.z <= most_z;
    }
  };

  SurfacePtr surface_;
  DyadicBins by_yz_;
  std::vector<Reach> reaches_;  // of each triangle
};

}  // namespace ombre::importing

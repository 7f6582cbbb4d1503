// Winding numbers of a mesh around points.
#pragma once

#include "import/fields/dyadic_bins.h"
#include "import/fields/ray_crossings.h"
#include "import/surfaces/surface.h"

namespace ombre::importing {

// Casts a ray along -x, with the arithmetic of RowWinding: both agree exactly at points with integer coordinates.
class PointWinding {
 public:
  explicit PointWinding(SurfacePtr surface);

  // Returns the winding number, which is exact for closed meshes; 0 for points that are not finite.
  int64_t at(Vec3 p) const;

  // The crossing of the ray with a triangle: `way` is 1 or -1 by its direction, or 0 if it misses.
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
  // Rounded bounds of a triangle, which quickly exclude most triangles of a bin from being crossed.
  struct Reach {
    float least_x, least_y, most_y, least_z, most_z;
    bool meets(Vec3 p) const {
      return least_x <= p.x && least_y <= p.y && p.y <= most_y && least_z <= p.z && p.z <= most_z;
    }
  };

  SurfacePtr surface_;
  DyadicBins by_yz_;
  std::vector<Reach> reaches_;  // by triangle
};

}  // namespace ombre::importing

// Ways from points to a surface.
#pragma once

#include <vector>

#include "base/math/box_tree.h"
#include "import/charts/surface_patch.h"

namespace ombre::importing {

class SurfaceRays {
 public:
  SurfaceRays(const std::vector<Vec3>& points, const std::vector<Corners>& triangles);

  double distance(Vec3 p) const;  // to the nearest point of the surface, mm
  // Returns the way from p along a direction of length 1 to where it first meets the surface. Where it does not within
  // several times the distance of the nearest point, returns the way to that point.
  Vec3 way_from(Vec3 p, Vec3 direction) const;

 private:
  std::vector<std::array<Vec3, 3>> triangles_;
  BoxTree tree_;
};

}  // namespace ombre::importing

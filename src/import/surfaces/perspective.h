// Transforms surfaces to the space of a perspective.
#pragma once

#include "import/surfaces/surface.h"
#include "program/field_source.h"

namespace ombre::importing {

// Converts depths. A perspective map keeps lines and planes straight only if depths shrink too: a point at depth d,
// where lengths shrink by a factor s, has the perspective depth d / s. That grows with d, up to the distance from the
// eye to the picture plane.
class PerspectiveDepth {
 public:
  PerspectiveDepth(const program::RayLattice& rays) : eye_(rays.eye_mm), first_(rays.first.x), step_(rays.step.x) {}
  // Returns the position along a ray, in voxels, of a perspective depth.
  double voxel(double perspective_depth) const {
    return (perspective_depth * eye_ / (eye_ - perspective_depth) - first_) / step_;
  }

 private:
  double eye_, first_, step_;
};

// Returns the surface with vertices (perspective depth, j, k). It is cut off in front of the eye, and open there.
Surface seen_in_perspective(const Surface& surface, const program::RayLattice& rays, const Affine& source_from_view);

}  // namespace ombre::importing

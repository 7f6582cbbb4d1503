// Surfaces as an eye sees them.
#pragma once

#include "import/surfaces/surface.h"
#include "program/field_source.h"

namespace ombre::importing {

// Perspective maps keep lines and planes only if depths shrink too: what lies at the depth d, where lengths shrink s
// times, gets the perspective depth d / s. It grows with the depth, up to the way from the eye to the picture plane.
class PerspectiveDepth {
 public:
  PerspectiveDepth(const program::RayLattice& rays) : eye_(rays.eye_mm), first_(rays.first.x), step_(rays.step.x) {}
  // The place between voxels of a ray, of a perspective depth.
  double voxel(double perspective_depth) const {
    return (perspective_depth * eye_ / (eye_ - perspective_depth) - first_) / step_;
  }

 private:
  double eye_, first_, step_;
};

// With vertices (perspective depth, j, k). What lies at the eye or behind it is cut off, and the surface open there.
Surface seen_in_perspective(const Surface& surface, const program::RayLattice& rays, const Affine& source_from_view);

}  // namespace ombre::importing

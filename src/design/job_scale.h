// The resolution of a job, for nodes whose precision depends on it.
#pragma once

#include <algorithm>

#include "base/math/vec.h"

namespace ombre::design {

// The usual greatest distance of triangles from the solid that they approximate, in voxels.
constexpr double voxels_of_triangles = 0.25;

struct JobScale {
  Vec3 voxel_mm;
  double triangles_mm = 0;  // greatest distance of triangles from the solid that they approximate

  // NOLINTNEXTLINE(google-explicit-constructor): voxels say all that most jobs know
  JobScale(Vec3 voxel) : JobScale(voxel, voxels_of_triangles * std::min({voxel.x, voxel.y, voxel.z})) {}
  JobScale(Vec3 voxel, double triangles) : voxel_mm(voxel), triangles_mm(triangles) {}
};

// Returns the scale in a space where lengths are multiplied by `factor`.
inline JobScale operator*(double factor, const JobScale& scale) {
  return {factor * scale.voxel_mm, factor * scale.triangles_mm};
}

}  // namespace ombre::design

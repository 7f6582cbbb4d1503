// How fine a job is, for nodes that are made as finely as it asks for.
#pragma once

#include <algorithm>

#include "base/math/vec.h"

namespace ombre::design {

// Triangles are usually so near to the solid that they stand for, in voxels.
constexpr double voxels_of_triangles = 0.25;

struct JobScale {
  Vec3 voxel_mm;
  double triangles_mm = 0;  // the farthest that triangles may be from the solid that they stand for

  // NOLINTNEXTLINE(google-explicit-constructor): voxels say all that most jobs know
  JobScale(Vec3 voxel) : JobScale(voxel, voxels_of_triangles * std::min({voxel.x, voxel.y, voxel.z})) {}
  JobScale(Vec3 voxel, double triangles) : voxel_mm(voxel), triangles_mm(triangles) {}
};

// Of a space in which lengths are so many times as large.
inline JobScale operator*(double factor, const JobScale& scale) {
  return {factor * scale.voxel_mm, factor * scale.triangles_mm};
}

}  // namespace ombre::design

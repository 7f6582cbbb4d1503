// The voxel lattice of a job: exact pitches, counts, and its position in the design's space.
#pragma once

#include <array>
#include <cstdint>

#include "base/math/box.h"
#include "base/math/index_box.h"
#include "base/math/pitch.h"

namespace ombre::voxel {

// A lattice whose voxel (i, j, k) has its centre at origin + (index + 0.5) * pitch. Indices always refer to the job's
// full box, even if only a part of it is evaluated.
struct Lattice {
  Vec3 origin;  // corner of least x, y, z in mm
  std::array<Pitch, 3> pitch;
  std::array<int64_t, 3> count{};  // number of voxels along each axis

  Vec3 center(int64_t i, int64_t j, int64_t k) const { return {center(0, i), center(1, j), center(2, k)}; }
  double center(size_t axis, int64_t n) const {
    return origin[static_cast<int>(axis)] + pitch[axis].times(static_cast<double>(n) + 0.5);
  }
  Vec3 voxel_mm() const { return {pitch[0].mm(), pitch[1].mm(), pitch[2].mm()}; }
  uint64_t voxels() const {
    return static_cast<uint64_t>(count[0]) * static_cast<uint64_t>(count[1]) * static_cast<uint64_t>(count[2]);
  }
  Box box() const;
};

// Returns the number of voxels of a box with size s at pitch v: ceil(s / v - 1e-6), at least one.
int64_t voxels_along(double size_mm, Pitch pitch);

// The voxels [lo, hi) on each axis.
using TileBox = IndexBox;

// Returns the box as a separate lattice.
Lattice part_of(const Lattice& lattice, const TileBox& box);

}  // namespace ombre::voxel

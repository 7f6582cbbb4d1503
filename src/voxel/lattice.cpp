#include "voxel/lattice.h"

#include <cmath>

namespace ombre::voxel {

Box Lattice::box() const {
  Vec3 hi = origin;
  for (int axis = 0; axis < 3; ++axis) hi[axis] += pitch[axis].times(static_cast<double>(count[axis]));
  return {origin, hi};
}

Lattice part_of(const Lattice& lattice, const TileBox& box) {
  Lattice part = lattice;
  for (size_t axis = 0; axis < 3; ++axis) {
    part.origin[static_cast<int>(axis)] += lattice.pitch[axis].times(static_cast<double>(box.lo[axis]));
    part.count[axis] = box.size(static_cast<int>(axis));
  }
  return part;
}

int64_t voxels_along(double size_mm, Pitch pitch) {
  constexpr double slack = 1e-6;  // tolerates rounding of sizes that are whole numbers of voxels
  const double exact = size_mm * static_cast<double>(pitch.denominator) / static_cast<double>(pitch.numerator);
  return std::max<int64_t>(1, static_cast<int64_t>(std::ceil(exact - slack)));
}

}  // namespace ombre::voxel

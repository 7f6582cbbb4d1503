// Boxes of voxel indices.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace ombre {

// A box of indices in [lo, hi) on each axis. Indices may be negative.
struct IndexBox {
  std::array<int64_t, 3> lo{}, hi{};

  int64_t size(int axis) const { return hi[static_cast<size_t>(axis)] - lo[static_cast<size_t>(axis)]; }
  int64_t voxels() const { return size(0) * size(1) * size(2); }
  bool is_empty() const { return !(lo[0] < hi[0] && lo[1] < hi[1] && lo[2] < hi[2]); }
  bool operator==(const IndexBox&) const = default;
};

inline IndexBox intersect(const IndexBox& a, const IndexBox& b) {
  IndexBox both;
  for (size_t axis = 0; axis < 3; ++axis) {
    both.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
    both.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
  }
  return both;
}

}  // namespace ombre

// Records which parts of a brick are inside a solid.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/math/box.h"

namespace ombre::fea {

// Number of parts of a brick along each axis. Bit x + 4 y + 16 z is 1 if that part is inside.
inline constexpr size_t parts_along = 4;
inline constexpr size_t parts_of_brick = 64;
using Fill = uint64_t;
inline constexpr Fill full_fill = ~Fill{0};
// Least share inside. Bricks with less are left out: they would hardly carry load, and make equations badly
// conditioned.
inline constexpr double least_fill = 1.0 / 16;

inline double fill_share(Fill fill) { return static_cast<double>(std::popcount(fill)) / parts_of_brick; }

inline bool has_part(Fill fill, size_t x, size_t y, size_t z) {
  return ((fill >> (x + parts_along * (y + parts_along * z))) & 1) != 0;
}

// Returns the centroid of the part inside; each coordinate goes from 0 to 1 in the brick.
Vec3 fill_centre(Fill fill);

// Returns the bounding box of the part inside, from 0 to 1 in the brick.
Box fill_box(Fill fill);

// Integrals of a^i b^j c^k over the part inside, as a share of the brick's volume, for i, j and k up to 2. The
// coordinates a, b, c are 1 at a brick's lower sides, and -1 at its upper ones.
struct FillMoments {
  std::array<double, 27> values{};

  explicit FillMoments(Fill fill);
  double operator()(size_t i, size_t j, size_t k) const { return values[i + 3 * (j + 3 * k)]; }
};

}  // namespace ombre::fea

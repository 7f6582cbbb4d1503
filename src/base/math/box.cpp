#include "base/math/box.h"

namespace ombre {

Box image(const Affine& map, const Box& box) {
  if (box.is_empty()) return box;
  Box result;
  for (int row = 0; row < 3; ++row) {
    double lo = map.offset[row], hi = lo;
    for (int column = 0; column < 3; ++column) {
      const double factor = map.rows[row][column];
      if (factor == 0) continue;  // avoids 0 * infinity, which is NaN
      const double a = factor * box.lo[column], b = factor * box.hi[column];
      lo += std::min(a, b);
      hi += std::max(a, b);
    }
    result.lo[row] = lo;
    result.hi[row] = hi;
  }
  return result;
}

}  // namespace ombre

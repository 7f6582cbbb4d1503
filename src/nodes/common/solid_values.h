// Values that are measured on solids.
#pragma once

#include "design/node.h"

namespace ombre::nodes {

// Returns the gradient direction of a solid's distance, of length 1, by differences over `step` mm, or a zero vector
// where the distance does not change.
inline design::VectorField normal_of(const design::Ask& ask, const design::SolidName& solid, double step) {
  std::array<program::Field, 3> rise;
  for (int axis = 0; axis < 3; ++axis) {
    Affine forth, back;
    forth.offset[axis] = step;
    back.offset[axis] = -step;
    rise[static_cast<size_t>(axis)] =
        ask.in.distance_to(solid, ask.p.mapped(forth)) - ask.in.distance_to(solid, ask.p.mapped(back));
  }
  const program::Field size = length(rise[0], rise[1], rise[2]), zero = ask.p.constant(0);
  const auto part = [&](size_t axis) { return select(size <= 0, zero, rise[axis] / size); };
  return {part(0), part(1), part(2)};
}

}  // namespace ombre::nodes

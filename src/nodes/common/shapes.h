// Distance functions that several solids use.
#pragma once

#include <array>

#include "design/node.h"
#include "program/field.h"

namespace ombre::nodes {

using program::Field;
using program::Point;

// Traits of solids whose g grows with the distance from the planes x = 0, y = 0 and z = 0, so that the nearest copy has
// the least g.
inline const design::Traits grows_outward{.nearest_copy_is_enough_from = Vec3{}};

// Returns a rotation that maps a direction to the z axis. The perpendicular direction nearest to x (or to y, if the
// direction is x) is mapped to x.
inline Affine turned_to_z(Vec3 direction) {
  const Vec3 w = (1 / length(direction)) * direction;
  const bool is_x = w.y == 0 && w.z == 0;
  const Vec3 along = is_x ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 across = along - dot(along, w) * w, u = (1 / length(across)) * across;
  return {{u, cross(w, u), w}, {}};
}

// Returns the distance to a corner, given the distances to its perpendicular faces.
inline Field corner(Field a, Field b) {
  return length(max(a, 0.0), max(b, 0.0)) + min(max(a, b), a.builder->constant(0));
}

inline Field corner(Field a, Field b, Field c) {
  return length(max(a, 0.0), max(b, 0.0), max(c, 0.0)) + min(max(max(a, b), c), a.builder->constant(0));
}

}  // namespace ombre::nodes

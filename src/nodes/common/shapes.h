// Distances that several solids share.
#pragma once

#include <array>

#include "design/node.h"
#include "program/field.h"

namespace ombre::nodes {

using program::Field;
using program::Point;

// Solids whose g grows away from the planes x = 0, y = 0 and z = 0, so that of copies the nearest has the least.
inline const design::Traits grows_outward{.nearest_copy_is_enough_from = Vec3{}};

// A rotation that takes a direction to the z axis; what is at a right angle to it and nearest to x (or y, where the
// direction is x) comes to lie along x.
inline Affine turned_to_z(Vec3 direction) {
  const Vec3 w = (1 / length(direction)) * direction;
  const bool is_x = w.y == 0 && w.z == 0;
  const Vec3 along = is_x ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 across = along - dot(along, w) * w, u = (1 / length(across)) * across;
  return {{u, cross(w, u), w}, {}};
}

// To the corner region of a shape whose distance to each of two perpendicular faces is known.
inline Field corner(Field a, Field b) {
  return length(max(a, 0.0), max(b, 0.0)) + min(max(a, b), a.builder->constant(0));
}

inline Field corner(Field a, Field b, Field c) {
  return length(max(a, 0.0), max(b, 0.0), max(c, 0.0)) + min(max(max(a, b), c), a.builder->constant(0));
}

}  // namespace ombre::nodes

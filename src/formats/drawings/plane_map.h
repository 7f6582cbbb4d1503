// Affine maps of the plane.
#pragma once

#include "base/math/vec.h"

namespace ombre::formats {

// The map x' = a x + c y + e, y' = b x + d y + f.
struct PlaneMap {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
};

inline PlaneMap operator*(const PlaneMap& m, const PlaneMap& n) {
  return {m.a * n.a + m.c * n.b, m.b * n.a + m.d * n.b,       m.a * n.c + m.c * n.d,
          m.b * n.c + m.d * n.d, m.a * n.e + m.c * n.f + m.e, m.b * n.e + m.d * n.f + m.f};
}

}  // namespace ombre::formats

// Text of points for messages.
#pragma once

#include <string>

#include "base/math/vec.h"
#include "base/text/text.h"

namespace ombre {

// Returns a point as text: "(1, 2.5, -3)".
inline std::string format_point(Vec3 p, int digits = 4) {
  return "(" + format_rounded(p.x, digits) + ", " + format_rounded(p.y, digits) + ", " + format_rounded(p.z, digits) +
         ")";
}

}  // namespace ombre

// The sRGB transfer function, IEC 61966-2-1.
#pragma once

#include "base/math/math.h"

namespace ombre {

// Converts an sRGB-encoded value to linear light. Both range from 0 to 1.
inline double linear_of_srgb(double v) { return v <= 0.04045 ? v / 12.92 : math::pow((v + 0.055) / 1.055, 2.4); }
// Converts linear light to an sRGB-encoded value.
inline double srgb_of_linear(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * math::pow(v, 1 / 2.4) - 0.055; }

}  // namespace ombre

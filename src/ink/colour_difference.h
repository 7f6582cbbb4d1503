// CIE L*a*b* and the visible difference of colours.
#pragma once

#include "base/math/vec.h"

namespace ombre::ink {

// L*, a* and b* under D50, the white of ICC profiles.
using Lab = Vec3;

// Returns L*a*b* of red, green and blue in sRGB (IEC 61966-2-1), 0 to 1, adapted to D50 by the method of Bradford.
Lab lab_of_srgb(const Vec3& srgb);

// X, Y and Z are relative to the white of D50, so that white is (1, 1, 1).
Vec3 xyz_of_lab(const Lab& lab);
Lab lab_of_xyz(const Vec3& xyz);

// Returns the difference by the formula CIEDE2000 with weights of 1 (G. Sharma, W. Wu and E. Dalal, 2005).
double ciede2000(const Lab& a, const Lab& b);

}  // namespace ombre::ink

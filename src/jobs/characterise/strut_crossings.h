// Splits struts where they meet others.
#pragma once

#include <vector>

#include "base/math/vec.h"

namespace ombre::compile {

struct GraphStrut {
  Vec3 start, end;
  double radius = 0;  // mm; 0: not known
};

// Struts that end or pass at most this share of the longest strut's length apart meet at a joint. Ends that are more
// than three times as far apart are different joints.
inline constexpr double same_joint = 1e-6;

// Returns the struts, split where an end of another lies on them and where they cross another. Where `period` is above
// 0, struts repeat along that axis, and copies split them, too. What is at most `tolerance` apart counts as one place.
std::vector<GraphStrut> split_at_joints(const std::vector<GraphStrut>& struts, Vec3 period, double tolerance);

}  // namespace ombre::compile

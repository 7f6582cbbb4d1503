// Operations on any number of solids.
#pragma once

#include <vector>

#include "base/system/progress.h"
#include "solids/solid.h"

namespace ombre::solids {

struct Work {
  int threads = 0;                 // 0: all cores
  const StopFlag* stop = nullptr;  // may be null

  void check() const;  // throws Cancelled once it is set
};

// Solids whose boxes do not meet are put side by side; others are united in pairs, the pairs in pairs, and so on.
Solid unite(std::vector<Solid> solids, const Work& work);
Solid intersect(const std::vector<Solid>& solids, const Work& work);
Solid subtract(const Solid& from, std::vector<Solid> others, const Work& work);
Solid moved(const Solid& solid, const Affine& map);
Solid hull(const std::vector<Solid>& solids);
// All sums of a point of the one and a point of the other.
Solid minkowski(const Solid& a, const Solid& b, const Work& work);

}  // namespace ombre::solids

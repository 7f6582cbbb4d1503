// Boolean and other operations on any number of solids.
#pragma once

#include <vector>

#include "base/system/progress.h"
#include "solids/solid.h"

namespace ombre::solids {

struct Work {
  int threads = 0;                 // 0: all cores
  const StopFlag* stop = nullptr;  // may be null

  void check() const;  // throws Cancelled once the stop flag is set
};

// Unites solids. Those whose boxes do not meet are placed side by side; others are united in pairs, the results in
// pairs, and so on.
Solid unite(std::vector<Solid> solids, const Work& work);
Solid intersect(const std::vector<Solid>& solids, const Work& work);
Solid subtract(const Solid& from, std::vector<Solid> others, const Work& work);
Solid moved(const Solid& solid, const Affine& map);
Solid hull(const std::vector<Solid>& solids);
// Returns the Minkowski sum: all sums of a point of `a` and a point of `b`.
Solid minkowski(const Solid& a, const Solid& b, const Work& work);

}  // namespace ombre::solids

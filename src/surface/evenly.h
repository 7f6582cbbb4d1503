// A part of a long list.
#pragma once

#include <vector>

namespace ombre::surface {

// No more than `most` of them, from everywhere in the list.
template <class T>
std::vector<T> evenly(const std::vector<T>& all, size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> some;
  for (size_t n = 0; n < most; ++n) some.push_back(all[n * all.size() / most]);
  return some;
}

}  // namespace ombre::surface

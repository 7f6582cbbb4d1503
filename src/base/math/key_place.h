// The place of a number among ascending keys.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ombre {

// A place between keys: the share `share` of the way from key `below` to the next one.
struct KeyPlace {
  size_t below = 0;
  double share = 0;
};

// Numbers beyond the keys, and those that are no number, have the place of an end. There is at least one key.
inline KeyPlace place_among(const std::vector<double>& keys, double at) {
  if (!(at > keys.front()) || keys.size() == 1) return {};
  if (at >= keys.back()) return {keys.size() - 2, 1};
  const auto below = static_cast<size_t>(std::ranges::upper_bound(keys, at) - keys.begin()) - 1;
  return {below, (at - keys[below]) / (keys[below + 1] - keys[below])};
}

}  // namespace ombre

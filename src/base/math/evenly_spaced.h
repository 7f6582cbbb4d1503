// A selection of a few elements of a long list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ombre {

// Returns up to `most` elements at even spacing, each from the middle of its share of the list.
template <class T>
std::vector<T> evenly_spaced(const std::vector<T>& all, size_t most) {
  const size_t count = std::min(all.size(), most);
  std::vector<T> chosen;
  chosen.reserve(count);
  for (size_t i = 0; i < count; ++i) chosen.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
  return chosen;
}

}  // namespace ombre

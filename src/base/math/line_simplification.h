// Leaves out points of a line that lie near it.
#pragma once

#include <utility>
#include <vector>

namespace ombre {

// Returns which of the points stay, by the algorithm of Douglas and Peucker (1973): the ends, and those without which
// the line would leave its points by more than the tolerance. `distance(n, begin, end)` is that of the point n from the
// segment between two others.
template <class Distance>
std::vector<bool> kept_points(size_t count, double tolerance, const Distance& distance) {
  std::vector<bool> kept(count);
  kept.front() = kept.back() = true;
  std::vector<std::pair<size_t, size_t>> open{{0, count - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    size_t farthest = begin;
    double most = tolerance;
    for (size_t n = begin + 1; n < end; ++n)
      if (const double off = distance(n, begin, end); off > most) most = off, farthest = n;
    if (farthest == begin) continue;
    kept[farthest] = true;
    open.emplace_back(begin, farthest);
    open.emplace_back(farthest, end);
  }
  return kept;
}

}  // namespace ombre

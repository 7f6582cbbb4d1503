// Boxes in a tree, to find those that meet another.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/box.h"

namespace ombre::surface {

inline bool meet(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

inline Box box_of(const std::array<Vec3, 3>& corners) {
  return hull(hull({corners[0], corners[0]}, {corners[1], corners[1]}), {corners[2], corners[2]});
}

// Boxes in the order of a space-filling curve. Four that follow each other make a group, four groups one of the next
// level, and so on.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box>& boxes);

  // Calls visit(number) for the boxes that meet this one.
  template <class Visit>
  void each_that_meets(const Box& box, const Visit& visit) const {
    if (!order_.empty()) ask(levels_.size() - 1, 0, box, 0, [&](size_t n) { visit(order_[n]); });
  }

  size_t groups() const { return levels_.size() > 1 ? levels_[1].size() : 0; }
  // Calls visit(a, b) for a box of the group and one that meets it, each pair from one group only.
  template <class Visit>
  void each_pair_that_meets(size_t group, const Visit& visit) const {
    const size_t first = group * width, last = std::min(first + width, order_.size());
    ask(levels_.size() - 1, 0, levels_[1][group], first, [&](size_t n) {
      for (size_t m = first; m < std::min(last, n); ++m)
        if (meet(levels_[0][m], levels_[0][n])) visit(order_[m], order_[n]);
    });
  }

 private:
  static constexpr size_t width = 4;

  // Of the boxes below a node those from `first` on.
  template <class Visit>
  void ask(size_t level, size_t node, const Box& box, size_t first, const Visit& visit) const {
    if (!meet(levels_[level][node], box)) return;
    if (level == 0) return visit(node);
    const size_t begin = node * width, end = std::min(begin + width, levels_[level - 1].size());
    for (size_t n = std::max(begin, first >> (2 * (level - 1))); n < end; ++n) ask(level - 1, n, box, first, visit);
  }

  std::vector<std::vector<Box>> levels_;  // the boxes themselves first
  std::vector<uint32_t> order_;           // of the boxes: their numbers
};

}  // namespace ombre::surface

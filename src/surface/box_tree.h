// Boxes in a tree, to find those that meet another.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box.h"

namespace ombre::surface {

inline bool meet(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

// Node n has children 2 n + 1 and 2 n + 2, leaves hold a few boxes each.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  const Box& box(uint32_t number) const { return boxes_[number]; }
  // Calls visit(number) for the boxes that meet this one.
  template <class Visit>
  void each_that_meets(const Box& box, const Visit& visit) const {
    if (!boxes_.empty()) ask(0, 0, order_.size(), box, visit);
  }

 private:
  static constexpr size_t leaf = 4;

  void build(size_t node, size_t begin, size_t end);

  template <class Visit>
  void ask(size_t node, size_t begin, size_t end, const Box& box, const Visit& visit) const {
    if (!meet(nodes_[node], box)) return;
    if (end - begin > leaf) {
      const size_t middle = (begin + end) / 2;
      ask(2 * node + 1, begin, middle, box, visit);
      ask(2 * node + 2, middle, end, box, visit);
      return;
    }
    for (size_t n = begin; n < end; ++n)
      if (meet(boxes_[order_[n]], box)) visit(order_[n]);
  }

  std::vector<Box> boxes_, nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace ombre::surface

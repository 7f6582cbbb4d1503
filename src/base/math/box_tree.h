// A tree of boxes that finds those that intersect a given box.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/math/box.h"

namespace ombre {

inline bool meet(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

// Returns the squared distance from the point to the box, 0 inside the box.
inline double squared_distance(Vec3 point, const Box& box) {
  Vec3 off;
  for (int axis = 0; axis < 3; ++axis)
    off[axis] = std::max({box.lo[axis] - point[axis], point[axis] - box.hi[axis], 0.0});
  return dot(off, off);
}

inline Box box_of(const std::array<Vec3, 3>& corners) {
  return hull(hull({corners[0], corners[0]}, {corners[1], corners[1]}), {corners[2], corners[2]});
}

// A tree of boxes sorted along a space-filling curve. Four consecutive boxes form a group, and four groups form one
// group of the next level.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box>& boxes);

  bool empty() const { return order_.empty(); }

  // Calls visit(number) for each box that intersects `box`.
  template <class Visit>
  void each_that_meets(const Box& box, const Visit& visit) const {
    if (!order_.empty()) ask(levels_.size() - 1, 0, box, 0, [&](size_t n) { visit(order_[n]); });
  }

  bool meets_any(const Box& box) const { return !order_.empty() && is_met(levels_.size() - 1, 0, box); }

  // Calls visit(number) for each box within `reach` of a point, until it returns false. Returns whether all were
  // visited.
  template <class Visit>
  bool each_within(Vec3 point, double reach, const Visit& visit) const {
    return order_.empty() || ask_within(levels_.size() - 1, 0, point, reach * reach, visit);
  }

  // Returns the least distance(number), or any distance that is at most `enough`; infinity if all exceed `reach`. The
  // distance to an element must be at least the distance to its box.
  template <class Distance>
  double nearest(Vec3 point, double reach, double enough, const Distance& distance) const {
    Search search{point, reach, enough};
    if (!order_.empty()) look(levels_.size() - 1, 0, search, distance);
    return search.found;
  }

  size_t groups() const { return levels_.size() > 1 ? levels_[1].size() : 0; }
  // Calls visit(a, b) for each box a of the group and each box b that intersects it. Each pair is visited from one
  // group only.
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

  // Visits the boxes below a node that intersect `box` and whose position in the order is `first` or later.
  template <class Visit>
  void ask(size_t level, size_t node, const Box& box, size_t first, const Visit& visit) const {
    if (!meet(levels_[level][node], box)) return;
    if (level == 0) return visit(node);
    const size_t begin = node * width, end = std::min(begin + width, levels_[level - 1].size());
    for (size_t n = std::max(begin, first >> (2 * (level - 1))); n < end; ++n) ask(level - 1, n, box, first, visit);
  }

  template <class Visit>
  bool ask_within(size_t level, size_t node, Vec3 point, double squared, const Visit& visit) const {
    if (squared_distance(point, levels_[level][node]) > squared) return true;
    if (level == 0) return visit(order_[node]);
    const size_t begin = node * width, end = std::min(begin + width, levels_[level - 1].size());
    for (size_t n = begin; n < end; ++n)
      if (!ask_within(level - 1, n, point, squared, visit)) return false;
    return true;
  }

  bool is_met(size_t level, size_t node, const Box& box) const {
    if (!meet(levels_[level][node], box)) return false;
    if (level == 0) return true;
    const size_t begin = node * width, end = std::min(begin + width, levels_[level - 1].size());
    for (size_t n = begin; n < end; ++n)
      if (is_met(level - 1, n, box)) return true;
    return false;
  }

  struct Search {
    Vec3 point;
    double most, enough, found = HUGE_VAL;
  };

  // Visits near boxes first, so that far ones can be skipped.
  template <class Distance>
  void look(size_t level, size_t node, Search& search, const Distance& distance) const {
    if (level == 0) {
      const double here = distance(order_[node]);
      if (here <= search.most) search.most = search.found = here;
      return;
    }
    const size_t begin = node * width, count = std::min(width, levels_[level - 1].size() - begin);
    std::array<std::pair<double, size_t>, width> below;
    for (size_t n = 0; n < count; ++n) {
      const std::pair<double, size_t> next{squared_distance(search.point, levels_[level - 1][begin + n]), begin + n};
      size_t place = n;
      for (; place > 0 && next < below[place - 1]; --place) below[place] = below[place - 1];
      below[place] = next;
    }
    for (size_t n = 0; n < count; ++n) {
      if (search.found <= search.enough || below[n].first > search.most * search.most) return;
      look(level - 1, below[n].second, search, distance);
    }
  }

  std::vector<std::vector<Box>> levels_;  // level 0 holds the boxes themselves
  std::vector<uint32_t> order_;           // numbers of the boxes in sorted order
};

}  // namespace ombre

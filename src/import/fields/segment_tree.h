// The distance to the nearest of many segments.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/box.h"

namespace ombre::importing {

struct LineSegment {
  Vec3 from, to;
  uint32_t number = 0;  // in its list
};

// The place on a segment that is nearest to a point: its share of the way from one end to the other.
double nearest_share(const LineSegment& segment, Vec3 p);
double squared_distance(const LineSegment& segment, Vec3 p);

// Those of the segments that may be the nearest to some point of the box.
std::vector<LineSegment> near(const std::vector<LineSegment>& segments, const Box& box);

// Boxes within boxes around the segments.
class SegmentTree {
 public:
  explicit SegmentTree(std::vector<LineSegment> segments);
  // Infinite when there are none.
  double distance(Vec3 p) const;
  // Of equally near ones the first in its list. There is one at least.
  const LineSegment& nearest(Vec3 p) const;
  // All that may be the nearest to some point of the box, in the order of their list.
  std::vector<LineSegment> near(const Box& box) const;
  Box bounds() const { return nodes_.empty() ? Box::empty() : nodes_[0].box; }

 private:
  // A leaf holds segments [begin, end); a branch has its first child behind it, and the other at `other`.
  struct Node {
    Box box;
    uint32_t begin = 0, end = 0;
    uint32_t other = 0;  // 0: a leaf
  };
  void build(uint32_t begin, uint32_t end);
  // Calls visit(segment), which returns the least squared distance so far, for all segments that may be nearer.
  template <class Visit>
  void visit_near(Vec3 p, const Visit& visit) const;

  std::vector<LineSegment> segments_;
  std::vector<Node> nodes_;
};

}  // namespace ombre::importing

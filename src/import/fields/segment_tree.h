// Finds the nearest of many segments.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/box.h"

namespace ombre::importing {

struct LineSegment {
  Vec3 from, to;
  uint32_t number = 0;  // number in its list
};

// Returns the point of a segment nearest to p, as a share of the length from its beginning to its end.
double nearest_share(const LineSegment& segment, Vec3 p);
double squared_distance(const LineSegment& segment, Vec3 p);

// Returns the segments that may be the nearest to some point of the box.
std::vector<LineSegment> near(const std::vector<LineSegment>& segments, const Box& box);

// A tree of boxes around segments.
class SegmentTree {
 public:
  explicit SegmentTree(std::vector<LineSegment> segments);
  // Returns the distance to the nearest segment, or infinity if there are none.
  double distance(Vec3 p) const;
  // Returns the nearest segment; the first in its list if several are equally near. The tree must not be empty.
  const LineSegment& nearest(Vec3 p) const;
  // Returns all segments that may be the nearest to some point of the box, in the order of their list.
  std::vector<LineSegment> near(const Box& box) const;
  Box bounds() const { return nodes_.empty() ? Box::empty() : nodes_[0].box; }

 private:
  // A leaf contains the segments [begin, end). A branch is followed by its first child; `other` is the index of its
  // second.
  struct Node {
    Box box;
    uint32_t begin = 0, end = 0;
    uint32_t other = 0;  // 0 in a leaf
  };
  void build(uint32_t begin, uint32_t end);
  // Calls visit(segment) for all segments that may be nearer than the best so far; it returns the least squared
  // distance so far.
  template <class Visit>
  void visit_near(Vec3 p, const Visit& visit) const;

  std::vector<LineSegment> segments_;
  std::vector<Node> nodes_;
};

}  // namespace ombre::importing

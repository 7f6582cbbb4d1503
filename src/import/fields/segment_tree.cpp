#include "import/fields/segment_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ombre::importing {
namespace {

constexpr uint32_t most_in_leaf = 4;
constexpr size_t deepest = 64;  // enough for halvings of 2^32 segments

Box around(const LineSegment& s) { return hull(Box{s.from, s.from}, Box{s.to, s.to}); }

double squared_distance(const Box& box, Vec3 p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
    sum += beyond * beyond;
  }
  return sum;
}

// Returns the squared distance from a box's middle beyond which no segment is the nearest to a point of the box. A
// point is half a diagonal from the middle at most, and so is its nearest segment from the middle's nearest; some room
// is added for rounding.
double squared_reach(double nearest_of_middle, const Box& box) {
  constexpr double room = 1 + 1e-9;
  const double reach = (nearest_of_middle + length(box.size())) * room;
  return reach * reach;
}

int longest_axis(Vec3 size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

double nearest_share(const LineSegment& segment, Vec3 p) {
  const Vec3 along = segment.to - segment.from;
  const double way = dot(along, along);
  return way > 0 ? std::clamp(dot(p - segment.from, along) / way, 0.0, 1.0) : 0;
}

double squared_distance(const LineSegment& segment, Vec3 p) {
  const Vec3 rest = (p - segment.from) - nearest_share(segment, p) * (segment.to - segment.from);
  return dot(rest, rest);
}

std::vector<LineSegment> near(const std::vector<LineSegment>& segments, const Box& box) {
  const Vec3 middle = box.center();
  double best = std::numeric_limits<double>::infinity();
  for (const LineSegment& segment : segments) best = std::min(best, squared_distance(segment, middle));
  const double most = squared_reach(std::sqrt(best), box);
  std::vector<LineSegment> found;
  for (const LineSegment& segment : segments)
    if (squared_distance(segment, middle) <= most) found.push_back(segment);
  return found;
}

SegmentTree::SegmentTree(std::vector<LineSegment> segments) : segments_(std::move(segments)) {
  if (!segments_.empty()) build(0, static_cast<uint32_t>(segments_.size()));
}

void SegmentTree::build(uint32_t begin, uint32_t end) {
  const size_t at = nodes_.size();
  Box box, middles;
  for (uint32_t n = begin; n < end; ++n) {
    box = hull(box, around(segments_[n]));
    const Vec3 middle = around(segments_[n]).center();
    middles = hull(middles, Box{middle, middle});
  }
  nodes_.push_back({box, begin, end, 0});
  if (end - begin <= most_in_leaf) return;
  const int axis = longest_axis(middles.size());
  std::stable_sort(segments_.begin() + begin, segments_.begin() + end,
                   [&](const auto& a, const auto& b) { return a.from[axis] + a.to[axis] < b.from[axis] + b.to[axis]; });
  const uint32_t half = begin + (end - begin) / 2;
  build(begin, half);
  nodes_[at].other = static_cast<uint32_t>(nodes_.size());
  build(half, end);
}

template <class Visit>
void SegmentTree::visit_near(Vec3 p, const Visit& visit) const {
  double best = std::numeric_limits<double>::infinity();
  struct Waiting {
    uint32_t node;
    double squared;
  };
  std::array<Waiting, deepest> waiting;
  size_t count = 0;
  if (!nodes_.empty()) waiting[count++] = {0, squared_distance(nodes_[0].box, p)};
  while (count > 0) {
    const auto [index, squared] = waiting[--count];
    if (squared > best) continue;
    const Node& node = nodes_[index];
    if (node.other == 0) {
      for (uint32_t n = node.begin; n < node.end; ++n) best = visit(segments_[n]);
      continue;
    }
    Waiting first{index + 1, squared_distance(nodes_[index + 1].box, p)};
    Waiting second{node.other, squared_distance(nodes_[node.other].box, p)};
    if (second.squared < first.squared) std::swap(first, second);
    waiting[count++] = second;
    waiting[count++] = first;  // the nearer one, which is visited next
  }
}

std::vector<LineSegment> SegmentTree::near(const Box& box) const {
  const Vec3 middle = box.center();
  const double most = squared_reach(distance(middle), box);
  std::vector<LineSegment> found;
  visit_near(middle, [&](const LineSegment& segment) {
    if (squared_distance(segment, middle) <= most) found.push_back(segment);
    return most;
  });
  std::ranges::sort(found, {}, &LineSegment::number);
  return found;
}

double SegmentTree::distance(Vec3 p) const {
  double best = std::numeric_limits<double>::infinity();
  visit_near(p, [&](const LineSegment& segment) { return best = std::min(best, squared_distance(segment, p)); });
  return std::sqrt(best);
}

const LineSegment& SegmentTree::nearest(Vec3 p) const {
  double best = std::numeric_limits<double>::infinity();
  const LineSegment* found = segments_.data();
  visit_near(p, [&](const LineSegment& segment) {
    const double squared = squared_distance(segment, p);
    if (squared < best || (squared == best && segment.number < found->number)) {
      best = squared;
      found = &segment;
    }
    return best;
  });
  return *found;
}

}  // namespace ombre::importing

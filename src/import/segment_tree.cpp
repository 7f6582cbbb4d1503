#include "import/segment_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ombre::importing {
namespace {

constexpr uint32_t most_in_leaf = 4;
constexpr size_t deepest = 64;  // halves of 2^32 segments

Box around(const LineSegment& s) { return hull(Box{s.from, s.from}, Box{s.to, s.to}); }

double squared_distance(const Box& box, Vec3 p) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::max({box.lo[axis] - p[axis], p[axis] - box.hi[axis], 0.0});
    sum += beyond * beyond;
  }
  return sum;
}

int longest_axis(Vec3 size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

double squared_distance(const LineSegment& segment, Vec3 p) {
  const Vec3 along = segment.to - segment.from, from = p - segment.from;
  const double way = dot(along, along);
  const double t = way > 0 ? std::clamp(dot(from, along) / way, 0.0, 1.0) : 0;
  const Vec3 rest = from - t * along;
  return dot(rest, rest);
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

double SegmentTree::distance(Vec3 p) const {
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
      for (uint32_t n = node.begin; n < node.end; ++n) best = std::min(best, squared_distance(segments_[n], p));
      continue;
    }
    Waiting first{index + 1, squared_distance(nodes_[index + 1].box, p)};
    Waiting second{node.other, squared_distance(nodes_[node.other].box, p)};
    if (second.squared < first.squared) std::swap(first, second);
    waiting[count++] = second;
    waiting[count++] = first;  // the nearer one, which comes next
  }
  return std::sqrt(best);
}

}  // namespace ombre::importing

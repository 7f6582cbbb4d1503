// Finds chains of a layer that cross each other.
#include "surface/outline/outline_overlaps.h"

#include <algorithm>

namespace ombre::surface {
namespace {

struct PlacedSegment {
  ChainSegment segment;
  Vec2 a, b;
  double x_lo, x_hi, y_lo, y_hi;
};

PlacedSegment placed(const OutlineGraph& graph, const ChainSegment& segment) {
  const Vec2 a = point_of(graph, segment.a), b = point_of(graph, segment.b);
  return {segment, a, b, std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y)};
}

bool are_opposite(double a, double b) { return (a < 0 && b > 0) || (a > 0 && b < 0); }

// True if two collinear segments have more than a point in common.
bool share_length(const PlacedSegment& s, const PlacedSegment& o) {
  const Vec2 along = s.b - s.a;
  const double p = dot(along, o.a - s.a), q = dot(along, o.b - s.a);
  return std::min(dot(along, along), std::max(p, q)) > std::max(0.0, std::min(p, q));
}

bool overlap(const PlacedSegment& s, const PlacedSegment& o) {
  const double oa = cross(s.b - s.a, o.a - s.a), ob = cross(s.b - s.a, o.b - s.a);
  const double sa = cross(o.b - o.a, s.a - o.a), sb = cross(o.b - o.a, s.b - o.a);
  if (oa == 0 && ob == 0 && sa == 0 && sb == 0) return share_length(s, o);
  const bool share_node = s.segment.a == o.segment.a || s.segment.a == o.segment.b || s.segment.b == o.segment.a ||
                          s.segment.b == o.segment.b;
  return !share_node && are_opposite(oa, ob) && are_opposite(sa, sb);
}

}  // namespace

std::vector<std::pair<ChainSegment, ChainSegment>> find_overlaps(const OutlineGraph& graph,
                                                                 const std::vector<OutlineChain>& chains) {
  std::vector<PlacedSegment> segments;
  for (uint32_t c = 0; c < chains.size(); ++c)
    for (size_t n = 0; n + 1 < chains[c].nodes.size(); ++n)
      segments.push_back(placed(graph, {c, chains[c].nodes[n], chains[c].nodes[n + 1]}));
  std::ranges::stable_sort(segments, {}, &PlacedSegment::x_lo);
  std::vector<std::pair<ChainSegment, ChainSegment>> found;
  for (size_t n = 0; n < segments.size(); ++n)
    for (size_t m = n + 1; m < segments.size() && segments[m].x_lo <= segments[n].x_hi; ++m) {
      const PlacedSegment &s = segments[n], &o = segments[m];
      if (s.y_lo <= o.y_hi && o.y_lo <= s.y_hi && overlap(s, o)) found.emplace_back(s.segment, o.segment);
    }
  return found;
}

}  // namespace ombre::surface

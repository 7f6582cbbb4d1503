#include "base/math/segment_sets.h"

#include <algorithm>
#include <cstdint>
#include <set>

#include "base/math/box_tree.h"
#include "base/math/disjoint_sets.h"
#include "base/math/periodic_copies.h"

namespace ombre {
namespace {

Box box_of(const Edge3& segment) { return hull(Box{segment[0], segment[0]}, Box{segment[1], segment[1]}); }

std::vector<Box> boxes_of(std::span<const Edge3> segments) {
  std::vector<Box> boxes;
  boxes.reserve(segments.size());
  for (const Edge3& segment : segments) boxes.push_back(box_of(segment));
  return boxes;
}

// Returns the segments that have a length and come first of those between the same places.
std::vector<uint32_t> distinct(const std::vector<uint32_t>& places) {
  std::set<std::pair<uint32_t, uint32_t>> known;
  std::vector<uint32_t> found;
  for (uint32_t n = 0; n < places.size() / 2; ++n) {
    const auto [from, to] = std::minmax(places[size_t{2} * n], places[size_t{2} * n + 1]);
    if (from != to && known.emplace(from, to).second) found.push_back(n);
  }
  return found;
}

// Returns the direction of a segment away from one of its ends.
Vec3 away_from(std::span<const Edge3> segments, uint32_t end) {
  const Edge3& segment = segments[end / 2];
  const Vec3 way = end % 2 == 0 ? segment[1] - segment[0] : segment[0] - segment[1];
  return (1 / length(way)) * way;
}

// Returns the part of a straight line that covers all the segments, which lie on it.
Edge3 covering(std::span<const Edge3> segments, const std::vector<uint32_t>& of) {
  if (of.size() == 1) return segments[of[0]];
  const Vec3 way = away_from(segments, 2 * of[0]);
  const auto before = [&](Vec3 a, Vec3 b) { return dot(a, way) < dot(b, way); };
  std::vector<Vec3> ends;
  for (const uint32_t n : of) ends.insert(ends.end(), segments[n].begin(), segments[n].end());
  const auto [first, last] = std::ranges::minmax_element(ends, before);
  return {*first, *last};
}

}  // namespace

std::vector<uint32_t> places_of_ends(std::span<const Edge3> segments, double tolerance, Vec3 period) {
  std::vector<Box> points;
  for (const Edge3& segment : segments)
    for (const Vec3 end : segment) {
      const Vec3 p = within_period(end, period);
      points.push_back({p, p});
    }
  const BoxTree tree(points);
  const Box first = Box{{0, 0, 0}, period}.expanded(tolerance);
  DisjointSets sets(points.size());
  for (uint32_t n = 0; n < points.size(); ++n) {
    const auto join = [&](size_t m) { sets.join(n, static_cast<uint32_t>(m)); };
    each_copy_that_meets(points[n], first, period, [&](Vec3 by) {
      const Vec3 p = points[n].lo + by;
      tree.each_that_meets(Box{p, p}.expanded(tolerance), join);
    });
  }
  std::vector<uint32_t> places(points.size());
  for (uint32_t n = 0; n < points.size(); ++n) places[n] = sets.root(n);
  return places;
}

std::vector<Edge3> joined_in_line(std::span<const Edge3> segments, double tolerance) {
  constexpr double straight = 1e-7;  // greatest difference of two unit vectors in line
  const std::vector<uint32_t> places = places_of_ends(segments, tolerance), kept = distinct(places);
  std::vector<std::vector<uint32_t>> ends_at(places.size()), parts(segments.size());
  for (const uint32_t n : kept)
    for (const uint32_t end : {2 * n, 2 * n + 1}) ends_at[places[end]].push_back(end);
  DisjointSets lines(segments.size());
  for (const std::vector<uint32_t>& ends : ends_at)
    for (size_t i = 0; i < ends.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (length(away_from(segments, ends[i]) + away_from(segments, ends[j])) < straight)
          lines.join(ends[i] / 2, ends[j] / 2);
  for (const uint32_t n : kept) parts[lines.root(n)].push_back(n);
  std::vector<Edge3> joined;
  for (const std::vector<uint32_t>& part : parts)
    if (!part.empty()) joined.push_back(covering(segments, part));
  return joined;
}

size_t most_within(std::span<const Edge3> segments, double distance) {
  const std::vector<Box> boxes = boxes_of(segments);
  const BoxTree tree(boxes);
  size_t most = 0;
  for (const Box& box : boxes) {
    size_t count = 0;
    tree.each_that_meets(box.expanded(2 * distance), [&](size_t) { ++count; });
    most = std::max(most, count);
  }
  return most;
}

}  // namespace ombre

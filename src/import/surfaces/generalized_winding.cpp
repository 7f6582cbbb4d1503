// Decides what is inside of a surface with gaps: points with a winding number of more than one half.
#include "import/surfaces/generalized_winding.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace ombre::importing {
namespace {

constexpr double half_a_turn = 0.5;
// Margin by which points in the plane of a flat gap, whose number is exactly one half, are outside in spite of
// rounding.
constexpr double tie = 1e-9;
// Limits of the octree; the rest is computed point by point.
constexpr size_t most_nodes = 1 << 18;
constexpr int most_levels = 9;
constexpr size_t most_visits = 3'000'000;  // visits of caps and triangles

bool meets(const Box& box, const std::array<Vec3, 3>& corners) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::max({corners[0][axis], corners[1][axis], corners[2][axis]}) < box.lo[axis]) return false;
    if (std::min({corners[0][axis], corners[1][axis], corners[2][axis]}) > box.hi[axis]) return false;
  }
  return true;
}

}  // namespace

// A node whose rule is not yet decided, with the caps and triangles that it has to consider.
struct GeneralizedWinding::Growth {
  uint32_t node = 0;
  int level = 0;
  Box box;
  double middle = 0;  // the sum of caps at its centre
  CapWinding::Relevant caps;
  std::vector<uint32_t> triangles;  // triangles of the surface that may meet the box
};

GeneralizedWinding::GeneralizedWinding(const Surface& surface) : GeneralizedWinding(surface, close_by_caps(surface)) {}

GeneralizedWinding::GeneralizedWinding(const Surface& surface, CappedSurface capped)
    : box_(bounds(surface)), closed_(capped.closed), caps_(std::move(capped.caps)), whole_(closed_) {
  nodes_.push_back({});
  if (box_.is_bounded()) grow(surface);
}

// Grows the octree level by level, so that it is equally fine everywhere if a limit is reached.
void GeneralizedWinding::grow(const Surface& surface) {
  Growth root{0, 0, box_, 0, caps_.all(), std::vector<uint32_t>(surface.triangles.size())};
  const Vec3 center = box_.center();
  caps_.sum({&center, 1}, root.caps.caps, {&root.middle, 1});
  std::iota(root.triangles.begin(), root.triangles.end(), 0u);
  std::vector<Growth> level{std::move(root)}, next;
  size_t visits = 0;
  while (!level.empty()) {
    for (Growth& growth : level) {
      visits += growth.caps.caps.size() + growth.triangles.size();
      if (const auto rule = settled(growth))
        nodes_[growth.node].place.rule = *rule;
      else if (growth.level < most_levels && nodes_.size() + 8 <= most_nodes && visits < most_visits)
        split(surface, growth, next);
      else
        leave_open(growth);
    }
    level.swap(next);
    next.clear();
  }
}

void GeneralizedWinding::leave_open(const Growth& growth) {
  const auto first = static_cast<uint32_t>(place_caps_.size());
  place_caps_.insert(place_caps_.end(), growth.caps.caps.begin(), growth.caps.caps.end());
  nodes_[growth.node].place = {Rule::difference, first, static_cast<uint32_t>(growth.caps.caps.size())};
}

std::optional<GeneralizedWinding::Rule> GeneralizedWinding::settled(const Growth& growth) const {
  const CapWinding::Estimate caps = caps_.estimate(growth.box, growth.middle, growth.caps);
  constexpr double doubt = CapWinding::error_of_many;
  if (caps.most + doubt < half_a_turn) return Rule::closed;
  if (!growth.triangles.empty() || !std::isfinite(caps.variation)) return std::nullopt;
  // No triangle lies here, so the difference is smooth, even across caps.
  const auto whole = static_cast<double>(whole_.at(growth.box.center()));
  const double winding = std::abs(whole - caps.middle);
  if (winding - caps.variation - doubt > half_a_turn) return Rule::inside;
  if (winding + caps.variation + doubt < half_a_turn) return Rule::outside;
  return std::nullopt;
}

void GeneralizedWinding::split(const Surface& surface, const Growth& growth, std::vector<Growth>& next) {
  const auto first = static_cast<uint32_t>(nodes_.size());
  nodes_[growth.node].first_child = first;
  nodes_.resize(nodes_.size() + 8);
  std::array<Vec3, 8> centers;
  for (unsigned child = 0; child < 8; ++child) centers[child] = child_box(growth.box, child).center();
  std::array<double, 8> middles;
  caps_.sum(centers, growth.caps.caps, middles);
  for (unsigned child = 0; child < 8; ++child) {
    const Box box = child_box(growth.box, child);
    Growth& grown = next.emplace_back(Growth{first + child, growth.level + 1, box, middles[child], {}, {}});
    grown.caps = caps_.relevant(grown.box, growth.caps);
    for (const uint32_t triangle : growth.triangles)
      if (meets(grown.box, surface.corners(triangle))) grown.triangles.push_back(triangle);
  }
}

Box GeneralizedWinding::child_box(const Box& box, unsigned child) {
  const Vec3 center = box.center();
  Box part = box;
  for (int axis = 0; axis < 3; ++axis) ((child >> axis & 1) != 0 ? part.lo : part.hi)[axis] = center[axis];
  return part;
}

unsigned GeneralizedWinding::child_at(const Box& box, Vec3 p) {
  const Vec3 center = box.center();
  return static_cast<unsigned>(p.x >= center.x) + 2 * static_cast<unsigned>(p.y >= center.y) +
         4 * static_cast<unsigned>(p.z >= center.z);
}

const GeneralizedWinding::Place& GeneralizedWinding::place_at(Vec3 p) const {
  uint32_t index = 0;
  Box box = box_;
  while (nodes_[index].first_child != 0) {
    const unsigned child = child_at(box, p);
    index = nodes_[index].first_child + child;
    box = child_box(box, child);
  }
  return nodes_[index].place;
}

bool GeneralizedWinding::contains(Vec3 p) const {
  if (!box_.contains(p)) return false;
  const Place& place = place_at(p);
  if (place.rule == Rule::inside || place.rule == Rule::outside) return place.rule == Rule::inside;
  const int64_t whole = whole_.at(p);
  if (place.rule == Rule::closed) return whole != 0;
  char inside = 0;
  decide(place, {&p, 1}, whole, {&inside, 1});
  return inside != 0;
}

void GeneralizedWinding::decide(const Place& place, std::span<const Vec3> points, int64_t whole,
                                std::span<char> inside) const {
  constexpr size_t most = 64;
  std::array<double, most> sums;
  const std::span<const uint32_t> caps(place_caps_.data() + place.first_cap, place.caps);
  for (size_t begin = 0; begin < points.size(); begin += most) {
    const size_t count = std::min(most, points.size() - begin);
    caps_.sum(points.subspan(begin, count), caps, std::span(sums).first(count));
    for (size_t n = 0; n < count; ++n)
      inside[begin + n] = std::abs(static_cast<double>(whole) - sums[n]) > half_a_turn + tie ? 1 : 0;
  }
}

int64_t GeneralizedWinding::RowPiece::first_beyond(int axis, double value) const {
  const double along = step[axis];
  if (along == 0) return end;
  const auto is_beyond = [&](int64_t i) { return along > 0 ? at(i)[axis] >= value : at(i)[axis] < value; };
  const double guess = std::ceil((value - origin[axis]) / along);
  int64_t i = guess <= static_cast<double>(begin) ? begin
              : guess >= static_cast<double>(end) ? end
                                                  : static_cast<int64_t>(guess);
  while (i > begin && is_beyond(i - 1)) --i;
  while (i < end && !is_beyond(i)) ++i;
  return i;
}

GeneralizedWinding::RowPiece GeneralizedWinding::within_bounds(Vec3 origin, Vec3 step, int64_t begin,
                                                               int64_t end) const {
  RowPiece row{origin, step, begin, end};
  for (int axis = 0; axis < 3 && row.begin < row.end; ++axis) {
    const double lo = box_.lo[axis], above = std::nextafter(box_.hi[axis], std::numeric_limits<double>::infinity());
    if (step[axis] == 0) {
      if (!(lo <= origin[axis] && origin[axis] < above)) row.end = row.begin;
      continue;
    }
    const bool rises = step[axis] > 0;
    const int64_t enters = row.first_beyond(axis, rises ? lo : above);
    row.end = row.first_beyond(axis, rises ? above : lo);
    row.begin = enters;
  }
  return row;
}

}  // namespace ombre::importing

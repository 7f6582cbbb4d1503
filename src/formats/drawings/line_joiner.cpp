#include "formats/drawings/line_joiner.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ombre::formats {
namespace {

struct Extent {
  Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  void add(const Ring& ring) {
    for (const Vec2& p : ring) {
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
  }
  double size() const { return std::max(0.0, std::max(hi.x - lo.x, hi.y - lo.y)); }
};

Extent extent_of(const Ring& ring) {
  Extent extent;
  extent.add(ring);
  return extent;
}

// Numbers that agree for equal lines, rounded to a tenth of the tolerance.
using LineKey = std::vector<int64_t>;

LineKey key_of(const std::vector<double>& numbers, double tolerance) {
  LineKey key;
  for (const double number : numbers) key.push_back(static_cast<int64_t>(std::llround(number * 10 / tolerance)));
  return key;
}

LineKey key_of_line(const Ring& line, double tolerance) {
  const Extent extent = extent_of(line);
  return key_of({extent.lo.x, extent.lo.y, extent.hi.x, extent.hi.y}, tolerance);
}

// The key of a ring has its box, the side of a square of its area, and its centre of gravity.
LineKey key_of_ring(const Ring& ring, double tolerance) {
  const Extent extent = extent_of(ring);
  Vec2 moment;
  double area = 0;
  for (size_t n = 0; n < ring.size(); ++n) {
    const Vec2 a = ring[n] - ring[0], b = ring[(n + 1) % ring.size()] - ring[0];
    area += cross(a, b);
    moment = moment + cross(a, b) * (a + b);
  }
  const Vec2 center = area == 0 ? Vec2{} : (1 / (3 * area)) * moment;
  const auto within = [](double value, double lo, double hi) { return std::clamp(value, lo, std::max(lo, hi)); };
  return key_of(
      {extent.lo.x, extent.lo.y, extent.hi.x, extent.hi.y, std::sqrt(std::abs(area)),
       within(ring[0].x + center.x, extent.lo.x, extent.hi.x), within(ring[0].y + center.y, extent.lo.y, extent.hi.y)},
      tolerance);
}

bool are_near(const Ring& a, const Ring& b, double tolerance) {
  if (a.size() != b.size()) return false;
  const auto agree = [&](auto at_b) {
    return std::ranges::all_of(a, [&](const Vec2& p) { return length(p - *at_b++) <= tolerance; });
  };
  return agree(b.begin()) || agree(b.rbegin());
}

}  // namespace

void LineJoiner::set_tolerance() {
  constexpr double widest = 1e-3, share = 1e-4;
  Extent extent;
  for (const Ring& line : lines_) extent.add(line);
  // Cells of far places have numbers that fit into 64 bits.
  constexpr double of_rounding = 1e-15;
  const double reach = std::max({-extent.lo.x, -extent.lo.y, extent.hi.x, extent.hi.y, 0.0});
  result_.tolerance = std::max(std::min(widest, share * extent.size()), of_rounding * reach);
  // Lines shorter than that would close by themselves.
  std::erase_if(lines_, [&](const Ring& line) { return extent_of(line).size() <= result_.tolerance; });
}

void LineJoiner::remove_doubles() {
  std::map<LineKey, std::vector<size_t>> kept;
  std::vector<Ring> lines;
  constexpr size_t most_compared = 16;
  for (Ring& line : lines_) {
    auto& others = kept[key_of_line(line, result_.tolerance)];
    const bool is_double = std::any_of(
        others.begin(), others.begin() + static_cast<std::ptrdiff_t>(std::min(others.size(), most_compared)),
        [&](size_t other) { return are_near(lines[other], line, result_.tolerance); });
    if (is_double) {
      ++result_.doubles;
      continue;
    }
    others.push_back(lines.size());
    lines.push_back(std::move(line));
  }
  lines_ = std::move(lines);
}

// Rings that agree in their box, area and centre are one, such as a circle and two arcs on it: otherwise they would cut
// each other out.
void LineJoiner::remove_double_rings() {
  std::map<LineKey, bool> seen;
  std::erase_if(result_.rings, [&](const Ring& ring) {
    bool& is_seen = seen[key_of_ring(ring, result_.tolerance)];
    if (is_seen) ++result_.doubles;
    return std::exchange(is_seen, true);
  });
}

std::pair<int64_t, int64_t> LineJoiner::cell_of(Vec2 p) const {
  return {static_cast<int64_t>(std::floor(p.x / result_.tolerance)),
          static_cast<int64_t>(std::floor(p.y / result_.tolerance))};
}

bool LineJoiner::is_closed(const Ring& ring) const {
  return ring.size() > 2 && length(ring.front() - ring.back()) <= result_.tolerance;
}

void LineJoiner::index_ends() {
  is_used_.assign(lines_.size(), false);
  for (End end = 0; end < 2 * lines_.size(); ++end)
    if (!is_closed(lines_[end / 2])) ends_[cell_of(point(end))].push_back(end);
}

LineJoiner::End LineJoiner::take_end(Vec2 at) {
  const auto [column, row] = cell_of(at);
  End best = SIZE_MAX;
  double nearest = result_.tolerance;
  for (int64_t x = column - 1; x <= column + 1; ++x)
    for (int64_t y = row - 1; y <= row + 1; ++y) {
      const auto cell = ends_.find({x, y});
      if (cell == ends_.end()) continue;
      auto& ends = cell->second;
      for (size_t n = 0; n < ends.size();) {
        if (is_used_[ends[n] / 2]) {
          ends[n] = ends.back();
          ends.pop_back();
          continue;
        }
        const double distance = length(point(ends[n]) - at);
        if (distance == 0) return ends[n];
        if (distance <= nearest) {
          nearest = distance;
          best = ends[n];
        }
        ++n;
      }
    }
  if (best != SIZE_MAX) result_.joined_gap = std::max(result_.joined_gap, nearest);
  return best;
}

// Appends lines to the ring's end until it is closed.
void LineJoiner::extend(Ring& ring) {
  while (!is_closed(ring)) {
    const End end = take_end(ring.back());
    if (end == SIZE_MAX) return;
    is_used_[end / 2] = true;
    Ring line = std::move(lines_[end / 2]);
    if (end % 2 == 1) std::reverse(line.begin(), line.end());
    ring.insert(ring.end(), line.begin() + 1, line.end());
  }
}

JoinedLines LineJoiner::join() {
  set_tolerance();
  if (lines_.empty()) return std::move(result_);
  remove_doubles();
  index_ends();
  for (size_t n = 0; n < lines_.size(); ++n) {
    if (is_used_[n]) continue;
    is_used_[n] = true;
    Ring ring = std::move(lines_[n]);
    extend(ring);
    std::reverse(ring.begin(), ring.end());
    extend(ring);
    std::reverse(ring.begin(), ring.end());
    if (is_closed(ring)) {
      result_.joined_gap = std::max(result_.joined_gap, length(ring.front() - ring.back()));
      ring.pop_back();
    } else if (ring.size() > 2) {
      ++result_.open;
      result_.widest_gap = std::max(result_.widest_gap, length(ring.front() - ring.back()));
    }
    if (ring.size() > 2)
      result_.rings.push_back(std::move(ring));
    else
      ++result_.single;
  }
  remove_double_rings();
  return std::move(result_);
}

}  // namespace ombre::formats

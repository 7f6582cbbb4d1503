// Finds the rectangles that may hold a point, in memory that does not depend on their sizes.
#include "import/dyadic_bins.h"

#include <algorithm>

namespace ombre::importing {

DyadicBins::DyadicBins(std::span<const Rectangle> rectangles, std::array<uint32_t, 2> finest) {
  if (rectangles.empty()) return;
  lo_ = rectangles[0].lo;
  hi_ = rectangles[0].hi;
  for (const Rectangle& r : rectangles) {
    for (size_t axis = 0; axis < 2; ++axis) {
      lo_[axis] = std::min(lo_[axis], r.lo[axis]);
      hi_[axis] = std::max(hi_[axis], r.hi[axis]);
    }
  }
  add_levels(finest);

  // Count, then fill: counts become beginnings, shifted by two so that filling moves them in place.
  for (Level& level : levels_) level.begins.assign(size_t{level.cells[0]} * level.cells[1] + 2, 0);
  for (const Rectangle& r : rectangles) {
    Level& level = levels_[level_of(r)];
    for_cells(level, r, [&](size_t cell) { ++level.begins[cell + 2]; });
  }
  for (Level& level : levels_) {
    for (size_t i = 2; i < level.begins.size(); ++i) level.begins[i] += level.begins[i - 1];
    level.ids.resize(level.begins.back());
  }
  for (const Rectangle& r : rectangles) {
    Level& level = levels_[level_of(r)];
    for_cells(level, r, [&](size_t cell) { level.ids[level.begins[cell + 1]++] = r.id; });
  }
  const auto is_unused = [](const Level& level) { return level.ids.empty(); };
  levels_.erase(std::remove_if(levels_.begin(), levels_.end(), is_unused), levels_.end());
}

void DyadicBins::add_levels(std::array<uint32_t, 2> finest) {
  for (std::array<uint32_t, 2> cells = finest;; cells = {(cells[0] + 1) / 2, (cells[1] + 1) / 2}) {
    Level level;
    for (size_t axis = 0; axis < 2; ++axis) {
      const double width = (hi_[axis] - lo_[axis]) / cells[axis];
      level.cells[axis] = width > 0 ? cells[axis] : 1;
      level.width[axis] = width > 0 ? width : 1;
    }
    levels_.push_back(std::move(level));
    if (cells[0] == 1 && cells[1] == 1) return;
  }
}

size_t DyadicBins::level_of(const Rectangle& r) const {
  for (size_t i = 0; i + 1 < levels_.size(); ++i) {
    const Level& level = levels_[i];
    if (r.hi[0] - r.lo[0] <= level.width[0] && r.hi[1] - r.lo[1] <= level.width[1]) return i;
  }
  return levels_.size() - 1;
}

template <class Visit>
void DyadicBins::for_cells(const Level& level, const Rectangle& r, const Visit& visit) const {
  const uint32_t u_end = column(level, 0, r.hi[0]), v_end = column(level, 1, r.hi[1]);
  for (uint32_t v = column(level, 1, r.lo[1]); v <= v_end; ++v)
    for (uint32_t u = column(level, 0, r.lo[0]); u <= u_end; ++u) visit(size_t{v} * level.cells[0] + u);
}

}  // namespace ombre::importing

// Finds the rectangles that may hold a point, in memory that does not depend on their sizes.
#include "import/fields/dyadic_bins.h"

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

  // Counting sort: counts become begins, shifted by two entries so that filling moves them into place.
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
  for (uint32_t v = finest[1];; v = (v + 1) / 2) {
    add_row_of_levels(finest[0], v);
    if (v == 1) return;
  }
}

// Adds levels whose cells have one height, from the finest width to the coarsest.
void DyadicBins::add_row_of_levels(uint32_t finest, uint32_t cells_v) {
  size_t count = 0;
  for (uint32_t u = finest;; u = (u + 1) / 2, ++count) {
    Level level;
    const std::array<uint32_t, 2> cells{u, cells_v};
    for (size_t axis = 0; axis < 2; ++axis) {
      const double width = (hi_[axis] - lo_[axis]) / cells[axis];
      level.cells[axis] = width > 0 ? cells[axis] : 1;
      level.width[axis] = width > 0 ? width : 1;
    }
    levels_.push_back(std::move(level));
    if (u == 1) break;
  }
  levels_a_row_ = count + 1;
}

size_t DyadicBins::level_of(const Rectangle& r) const {
  const size_t rows = levels_.size() / levels_a_row_;
  size_t u = 0, v = 0;
  while (u + 1 < levels_a_row_ && r.hi[0] - r.lo[0] > levels_[u].width[0]) ++u;
  while (v + 1 < rows && r.hi[1] - r.lo[1] > levels_[v * levels_a_row_].width[1]) ++v;
  return v * levels_a_row_ + u;
}

template <class Visit>
void DyadicBins::for_cells(const Level& level, const Rectangle& r, const Visit& visit) const {
  const uint32_t u_end = column(level, 0, r.hi[0]), v_end = column(level, 1, r.hi[1]);
  for (uint32_t v = column(level, 1, r.lo[1]); v <= v_end; ++v)
    for (uint32_t u = column(level, 0, r.lo[0]); u <= u_end; ++u) visit(size_t{v} * level.cells[0] + u);
}

}  // namespace ombre::importing

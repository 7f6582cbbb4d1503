#include "nodes/values/whole_cells.h"

#include <algorithm>
#include <cmath>

namespace ombre::nodes {
namespace {

// Lines along a border of cells, with rounding, do not cut them.
constexpr double room = 1e-6;

class Grid {
 public:
  Grid(size_t columns, size_t rows) : columns(columns), rows(rows), kept(columns * rows) {}

  const size_t columns, rows;
  std::vector<char> kept;

  // Keeps the cells whose middles lie within the lines.
  void keep_inside(const std::vector<CellLine>& border) {
    std::vector<std::vector<double>> crossings(rows);
    for (const auto& [a, b] : border) {
      const Vec2 low = a.y < b.y ? a : b, high = a.y < b.y ? b : a;
      const double first = std::ceil(low.y - 0.5), last = std::ceil(high.y - 0.5);
      for (double j = std::max(0.0, first); j < last && j < static_cast<double>(rows); ++j)
        crossings[static_cast<size_t>(j)].push_back(low.x + (j + 0.5 - low.y) / (high.y - low.y) * (high.x - low.x));
    }
    for (size_t j = 0; j < rows; ++j) {
      std::ranges::sort(crossings[j]);
      size_t passed = 0;
      for (size_t i = 0; i < columns; ++i) {
        while (passed < crossings[j].size() && crossings[j][passed] < static_cast<double>(i) + 0.5) ++passed;
        kept[j * columns + i] = passed % 2 == 1 ? 1 : 0;
      }
    }
  }

  void drop_cut(const CellLine& line) {
    const auto& [a, b] = line;
    const auto [i_begin, i_end] = cells_of(a.x, b.x, columns);
    const auto [j_begin, j_end] = cells_of(a.y, b.y, rows);
    for (size_t j = j_begin; j < j_end; ++j)
      for (size_t i = i_begin; i < i_end; ++i)
        if (cuts(a, b, static_cast<double>(i), static_cast<double>(j))) kept[j * columns + i] = 0;
  }

 private:
  static std::array<size_t, 2> cells_of(double a, double b, size_t count) {
    const double most = static_cast<double>(count);
    const double begin = std::clamp(std::floor(std::min(a, b)), 0.0, most);
    const double end = std::clamp(std::floor(std::max(a, b)) + 1, 0.0, most);
    return {static_cast<size_t>(begin), static_cast<size_t>(end)};
  }
  // Clips the line to the inside of a cell (Y.-D. Liang and B. Barsky, ACM Transactions on Graphics 3, 1984).
  static bool cuts(Vec2 a, Vec2 b, double i, double j) {
    double begin = 0, end = 1;
    const auto clip = [&](double from, double to, double low) {
      const double way = to - from, lo = low + room, hi = low + 1 - room;
      if (way == 0) {
        if (from <= lo || from >= hi) end = -1;
        return;
      }
      const double first = (lo - from) / way, second = (hi - from) / way;
      begin = std::max(begin, std::min(first, second));
      end = std::min(end, std::max(first, second));
    };
    clip(a.x, b.x, i);
    clip(a.y, b.y, j);
    return begin < end;
  }
};

class WholeCells final : public program::FieldSource {
 public:
  explicit WholeCells(Grid grid) : grid_(std::move(grid)) {
    content_ = hash_bytes("whole cells " + std::to_string(grid_.columns) + " " +
                          std::string(grid_.kept.data(), grid_.kept.size()));
  }
  std::string name() const override { return "whole cells"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view) const override { return 0; }
  double sample(int, Vec3 p) const override {
    return is_finite(p) ? grid_.kept[row(p.y) * grid_.columns + column(p.x)] : 0;
  }
  Interval range(int, const Box& box) const override {
    constexpr size_t most = 256;
    if (!box.is_bounded()) return {0, 1};
    const size_t i0 = column(box.lo.x), i1 = column(box.hi.x), j0 = row(box.lo.y), j1 = row(box.hi.y);
    if ((i1 - i0 + 1) * (j1 - j0 + 1) > most) return {0, 1};
    Interval found{1, 0};
    for (size_t j = j0; j <= j1; ++j)
      for (size_t i = i0; i <= i1; ++i) {
        const double here = grid_.kept[j * grid_.columns + i];
        found = {std::min(found.lo, here), std::max(found.hi, here)};
      }
    return found;
  }

 private:
  static size_t index(double v, size_t count) {
    return static_cast<size_t>(std::clamp(std::floor(v), 0.0, static_cast<double>(count - 1)));
  }
  size_t column(double u) const { return index(u, grid_.columns); }
  size_t row(double v) const { return index(v, grid_.rows); }

  Grid grid_;
  Hash content_;
};

}  // namespace

program::SourceField whole_cells(size_t columns, size_t rows, const std::vector<CellLine>& border) {
  Grid grid(columns, rows);
  grid.keep_inside(border);
  for (const CellLine& line : border) grid.drop_cut(line);
  const bool has_any = std::ranges::any_of(grid.kept, [](char kept) { return kept != 0; });
  return has_any ? std::make_shared<WholeCells>(std::move(grid)) : nullptr;
}

}  // namespace ombre::nodes

// Finds the rectangles that may hold a point, in memory that does not depend on their sizes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ombre::importing {

// Grids of bins for every combination of cell width and height, in powers of two. A rectangle is stored in the finest
// level whose cells are not smaller than it along either axis, so in about four cells. A query looks up one cell in
// each used level.
class DyadicBins {
 public:
  // A closed rectangle with finite coordinates.
  struct Rectangle {
    std::array<double, 2> lo, hi;
    uint32_t id = 0;
  };

  // Constructs the bins; `finest` is the number of cells of the finest level along each axis, at least 1.
  DyadicBins(std::span<const Rectangle> rectangles, std::array<uint32_t, 2> finest);

  // Calls visit(id) for all rectangles that contain (u, v), and for some others.
  template <class Visit>
  void at(double u, double v, const Visit& visit) const {
    if (!(lo_[0] <= u && u <= hi_[0] && lo_[1] <= v && v <= hi_[1])) return;
    for (const Level& level : levels_) {
      const size_t cell = size_t{column(level, 1, v)} * level.cells[0] + column(level, 0, u);
      for (uint64_t i = level.begins[cell]; i < level.begins[cell + 1]; ++i) visit(level.ids[i]);
    }
  }

 private:
  struct Level {
    std::array<double, 2> width;  // width of a cell along each axis
    std::array<uint32_t, 2> cells;
    std::vector<uint64_t> begins;  // index of the first id of each cell; one entry more than there are cells
    std::vector<uint32_t> ids;
  };

  uint32_t column(const Level& level, size_t axis, double value) const {
    const double at = (value - lo_[axis]) / level.width[axis];
    const uint32_t last = level.cells[axis] - 1;
    return at < last ? static_cast<uint32_t>(at) : last;
  }
  template <class Visit>
  void for_cells(const Level& level, const Rectangle& rectangle, const Visit& visit) const;
  void add_levels(std::array<uint32_t, 2> finest);
  void add_row_of_levels(uint32_t finest, uint32_t cells_v);
  size_t level_of(const Rectangle& rectangle) const;

  std::array<double, 2> lo_{1, 1}, hi_{0, 0};  // bounds of all rectangles; initially empty
  std::vector<Level> levels_;                  // ordered by width, then height; unused levels are removed
  size_t levels_a_row_ = 1;
};

}  // namespace ombre::importing

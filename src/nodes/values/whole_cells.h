// The cells of a map that the border of a surface does not cut.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "program/field_source.h"

namespace ombre::nodes {

// The ends of a line in u and v, in cells.
using CellLine = std::array<Vec2, 2>;

// Returns a source whose channel 0 is 1 at u, v (x and y) of a cell that lies within the lines whole, else 0; null if
// no cell does. The lines form closed curves. There may be at most `most_whole_cells` cells.
inline constexpr double most_whole_cells = 4e6;
program::SourceField whole_cells(size_t columns, size_t rows, const std::vector<CellLine>& border);

}  // namespace ombre::nodes

// Lengths in mm of short ways among the cells of a map, to first order.
#pragma once

#include "nodes/common/cell_map.h"
#include "nodes/common/field_math.h"

namespace ombre::nodes {

// A place folded into the eighth of a cell with positive coordinates, measured from the cell's centre: each coordinate
// runs from 0 to 0.5.
Slope folded_into_cell(const Slope& place);
// A place measured from the centre of its cell: each coordinate runs from -0.5 to 0.5.
Slope from_centre_of_cell(const Slope& place);

// The edges of a cell at a point as vectors in mm, in space or, if they are perpendicular, in their own directions.
struct CellMetric {
  std::array<Slope, 3> edges;

  // With `is_folded`, ways are measured in the eighth of the cell into which the point is folded.
  static CellMetric at(const CellMap& map, const Point& p, bool is_folded);
  // Returns the metric of walls along w: ways along w have no length.
  CellMetric along_w() const;
  // Returns a way in mm that is given in cells.
  Slope way(const Slope& cells) const;
  Slope way(Vec3 cells) const;
};

// The nearest point of a straight strut.
struct NearestOfStrut {
  Field along;             // from 0 at its start to 1 at its end
  Field squared_distance;  // mm^2
};
NearestOfStrut nearest_of_strut(const CellMetric& metric, const Slope& place, Vec3 start, Vec3 end);

}  // namespace ombre::nodes

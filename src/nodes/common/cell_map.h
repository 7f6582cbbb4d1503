// Maps of cells as parameters. A map takes a point to its place u, v, w among cells, whose borders are whole numbers.
#pragma once

#include "design/node.h"
#include "nodes/common/slopes.h"

namespace ombre::nodes {

using program::Field;
using program::Point;

// A map that a node gives, or none. Nodes that give maps have the outputs of `CellOutputs`
// (nodes/values/cell_outputs.h).
struct CellMap {
  design::Numbers3 place;
  std::array<design::Numbers3, 3> slopes;     // derivatives of u, v and w by x, y and z
  design::Numbers3 size;                      // lengths of the edges of a cell, mm
  design::Numbers3 index;                     // whole numbers of the cell along u, v and w
  bool is_perpendicular = false;              // the edges of cells are perpendicular everywhere
  std::optional<design::Number> from_border;  // distance to the border of the surface that cells lie on, mm
  design::SolidName region;                   // the part of space with cells; none: all space
  design::GivenOutput from;

  bool is_given() const { return from.node != nullptr; }

  Slope place_at(const Point& p) const { return fields(place, p); }
  Slope slope_at(size_t axis, const Point& p) const { return fields(slopes[axis], p); }
  Slope size_at(const Point& p) const { return fields(size, p); }

  // Returns a box around the points of `where` that are at most `margin` away from the region.
  Box reach(const Box& where, double margin) const;
  // Returns g of a solid that is cut to the region.
  Field cut(Field distance, const design::Inputs& in, const Point& p) const;
  Field cut_membership(Field flag, const design::Inputs& in, const Point& p, design::Border border) const;

 private:
  static Slope fields(const design::Numbers3& numbers, const Point& p) {
    return {numbers.x(p), numbers.y(p), numbers.z(p)};
  }
};

// Cells that are equal boxes along x, y and z.
struct EqualBoxes {
  Vec3 corner;  // where u, v and w are 0, mm
  Vec3 steps;   // lengths of a cell, mm
};
// Returns nothing if cells of the map are bent, turned or mirrored, or change their size.
std::optional<EqualBoxes> equal_boxes(const CellMap& map);

// Returns the squared length of the gradient, per mm^2, of a function with the derivatives `by` u, v and w.
Field squared_slope(const CellMap& map, const Slope& by, const Point& p);

}  // namespace ombre::nodes

namespace ombre::design {

template <>
struct Port<nodes::CellMap> {
  static PortText text(const Domain&) { return {"map of cells", "maps of cells", "Value"}; }
  static bool read(const Data& data, const Domain&, nodes::CellMap& value, const Reader& reader);
  static Data write(const nodes::CellMap& value, bool) { return value.is_given() ? write_output(value.from) : Data(); }
  static bool is_constant(const nodes::CellMap& value) { return !value.is_given(); }
};

}  // namespace ombre::design

// What nodes made of struts, and tiles, say of themselves to those who write struts as beams.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/math/interval.h"
#include "design/node.h"

namespace ombre::nodes {

// A conical frustum, closed at each end by the half ball beyond it, or flat. mm.
struct StrutShape {
  Vec3 start, end;
  double start_radius = 0, end_radius = 0;
  bool has_flat_ends = false;
};

// Of how many struts the node itself is made: 0 for all but lattices and struts.
size_t strut_count(const design::Node& node);

// The struts of a lattice, or the one of a strut. Nothing for other nodes, and where the radius is no linear function
// of t or not above 0 at both ends.
std::optional<std::vector<StrutShape>> struts_of(const design::Node& node);

// Copies of an input, moved by whole multiples of the steps.
struct TileCopies {
  Vec3 steps;                       // 0: there is one copy along this axis, with the index 0
  std::array<Interval, 3> indices;  // from the first to the last copy, unbounded where nothing limits them
};

// Nothing for nodes that are no tile.
std::optional<TileCopies> tile_copies_of(const design::Node& node);

}  // namespace ombre::nodes

// Struts and tiles of nodes, for formats that store struts as beams.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/math/interval.h"
#include "design/node.h"

namespace ombre::nodes {

// A conical frustum with hemispherical or flat ends; lengths in mm.
struct StrutShape {
  Vec3 start, end;
  double start_radius = 0, end_radius = 0;
  bool has_flat_ends = false;
};

// Returns the number of struts of which the node itself consists, which is 0 for all nodes except lattices and struts.
size_t strut_count(const design::Node& node);

// Returns the struts of a lattice or strut node. Returns nothing for other nodes, and if the radius is not a linear
// function of t or not above 0 at both ends.
std::optional<std::vector<StrutShape>> struts_of(const design::Node& node);

// Copies of an input, translated by integer multiples of the steps.
struct TileCopies {
  Vec3 steps;                       // a step of 0 means a single copy along this axis, with index 0
  std::array<Interval, 3> indices;  // indices of the first and last copy; unbounded if there is no limit
};

// Returns nothing for nodes that are not tiles.
std::optional<TileCopies> tile_copies_of(const design::Node& node);

}  // namespace ombre::nodes

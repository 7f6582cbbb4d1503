// Struts and tiles of nodes, for formats that store struts as beams.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "design/node.h"
#include "design/ports/solid_name.h"

namespace ombre::nodes {

// A conical frustum with hemispherical or flat ends; lengths in mm.
struct StrutShape {
  Vec3 start, end;
  double start_radius = 0, end_radius = 0;
  bool has_flat_ends = false;
};

// Copies of an input, translated by integer multiples of the steps.
struct TileCopies {
  Vec3 steps;                       // a step of 0 means a single copy along this axis, with index 0
  std::array<Interval, 3> indices;  // indices of the first and last copy; unbounded if there is no limit
};

struct NodeStruts {
  std::vector<StrutShape> struts;
  std::optional<TileCopies> copies = {};  // of all of them
  design::SolidName region = {};          // only what lies inside is kept; none: struts are whole
};

// Returns true for lattices and struts, of which the node itself consists.
bool makes_struts(const design::Node& node);

// Returns the number of these struts; 0 if there are none, or if their number is not known.
size_t strut_count(const design::Node& node);

// The struts of a node, or why they are no straight struts whose radii change linearly and are above 0.
struct StrutsOrReason {
  std::optional<NodeStruts> struts;
  std::string reason = {};  // follows "because"; empty if the node makes no struts
};
StrutsOrReason struts_of(const design::Node& node);

// Returns nothing for nodes that are not tiles.
std::optional<TileCopies> tile_copies_of(const design::Node& node);

}  // namespace ombre::nodes

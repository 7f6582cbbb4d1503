// Functions of the node families that struts.h combines.
#pragma once

#include "design/values.h"
#include "nodes/common/struts.h"

namespace ombre::nodes {

// Returns the radii at the start and the end of a strut. Returns nothing if the radius is not a linear function of t,
// or not above 0 at both ends.
std::optional<std::array<double, 2>> end_radii(const design::Number& radius);

// For nodes that are not a lattice, or not a strut, these functions return 0, false or nothing.
size_t lattice_strut_count(const design::Node& node);
std::optional<std::vector<StrutShape>> lattice_struts(const design::Node& node);
bool is_single_strut(const design::Node& node);
std::optional<StrutShape> single_strut(const design::Node& node);

}  // namespace ombre::nodes

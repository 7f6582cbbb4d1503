// What each family tells struts.h of its nodes.
#pragma once

#include "design/values.h"
#include "nodes/common/struts.h"

namespace ombre::nodes {

// At the start and the end of a strut. Nothing where it is no linear function of t, or not above 0 at both.
std::optional<std::array<double, 2>> end_radii(const design::Number& radius);

// 0 and nothing for nodes that are no lattice, or no strut.
size_t lattice_strut_count(const design::Node& node);
std::optional<std::vector<StrutShape>> lattice_struts(const design::Node& node);
bool is_single_strut(const design::Node& node);
std::optional<StrutShape> single_strut(const design::Node& node);

}  // namespace ombre::nodes

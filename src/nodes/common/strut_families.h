// Functions of the node families that struts.h combines.
#pragma once

#include <functional>

#include "design/values.h"
#include "nodes/common/struts.h"

namespace ombre::nodes {

// Returns the radii at the start and the end of a strut. Returns nothing if the radius is not a linear function of t,
// or not above 0 at both ends.
std::optional<std::array<double, 2>> end_radii(const design::Number& radius);

// Why struts are no beams if end_radii returns nothing.
inline constexpr const char* radius_is_not_linear = "the radius is not linear along the struts";

// StrutMaker makes the struts of one node of a family.
struct StrutMaker {
  size_t count = 0;  // 0: not known
  std::function<StrutsOrReason()> make;
};

// Each returns how the struts of a node of one family are made, and nothing for nodes of other families.
std::optional<StrutMaker> lattice_struts(const design::Node& node);
std::optional<StrutMaker> point_struts(const design::Node& node);
std::optional<StrutMaker> single_strut(const design::Node& node);

}  // namespace ombre::nodes

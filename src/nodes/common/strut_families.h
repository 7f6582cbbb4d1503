// Functions of the node families that struts.h combines.
#pragma once

#include <functional>

#include "design/values.h"
#include "nodes/common/struts.h"

namespace ombre::nodes {

// Why struts are no beams whose radius depends on more than the position along them.
inline constexpr const char* radius_varies_by_place = "the radius of the struts varies by place";

// The radii at the start and the end of a strut, or why there are none: the radius is not a linear function of t, or
// not above 0 at both ends.
struct EndRadii {
  std::optional<std::array<double, 2>> radii;
  std::string reason = {};  // follows "because"
};
EndRadii end_radii(const design::Number& radius);

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

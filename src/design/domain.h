// The values that a parameter may have, for checks, help and forms.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/math/box.h"

namespace ombre::design {

// All of a design lies within this distance (mm) of the origin on each axis.
inline constexpr double design_limit_mm = 1e6;
inline Box design_space() { return Box::centered({design_limit_mm, design_limit_mm, design_limit_mm}); }
// Returns false for a box that goes on to the end of the space along an axis.
inline bool has_ends(const Box& box) {
  const Vec3 size = box.size();
  return box.is_bounded() && size.x < design_limit_mm && size.y < design_limit_mm && size.z < design_limit_mm;
}

// The meaning of a parameter's numbers in space, for handles that move them.
enum class InSpace : uint8_t {
  nothing,
  point,      // a place, or how far something is moved; also each point of a list
  profile,    // points [rho, z] beside the z axis
  direction,  // of any length
  offset,     // a length from the origin along the first direction among the parameters
  radius,     // a length from the first point among the parameters, or from the axis there along the first direction
  surface     // a place on or near a surface, which a click in a picture chooses
};

// Returns "point" and so on, and "" for nothing.
std::string_view name_of(InSpace in_space);

struct Domain {
  std::string_view unit;  // "mm", "deg", or empty
  InSpace in_space = InSpace::nothing;
  double least = -std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::infinity();
  bool above_least = false;            // must be greater than `least`, not equal
  bool required = false;               // has no default
  std::vector<std::string> choices;    // words of a Choice
  std::vector<std::string> variables;  // known in expressions besides the coordinates
  bool may_mix = false;                // a material may be a mixture
  bool one_is_enough = false;     // of three numbers, a single one may be given, which stands for itself and two zeros
  bool child_attributes = false;  // expressions may use attributes of the inputs by name
};

// Returns " (mm)" for the unit mm, or "" if there is none.
inline std::string unit_text(const Domain& domain) {
  return domain.unit.empty() ? "" : " (" + std::string(domain.unit) + ")";
}

// Returns the coordinates and the domain's additional variables.
std::vector<std::string> known_variables(const Domain& domain);

inline Domain any(std::string_view unit = "") {
  Domain domain;
  domain.unit = unit;
  return domain;
}
inline Domain positive(std::string_view unit) {
  Domain domain = any(unit);
  domain.least = 0;
  domain.above_least = true;
  return domain;
}
inline Domain not_negative(std::string_view unit) {
  Domain domain = any(unit);
  domain.least = 0;
  return domain;
}
inline Domain from_to(double least, double greatest, std::string_view unit = "") {
  Domain domain = any(unit);
  domain.least = least;
  domain.greatest = greatest;
  return domain;
}
inline Domain one_of(std::vector<std::string> choices) {
  Domain domain;
  domain.choices = std::move(choices);
  return domain;
}
inline Domain required(Domain domain = {}) {
  domain.required = true;
  return domain;
}
inline Domain in_space(InSpace what, Domain domain) {
  domain.in_space = what;
  return domain;
}
// Domain of three numbers, in whose place a single one may be given.
inline Domain one_or_three(Domain domain = {}) {
  domain.one_is_enough = true;
  return domain;
}
// Domain of materials that may be mixtures.
inline Domain mixable(Domain domain = {}) {
  domain.may_mix = true;
  return domain;
}
inline Domain with_variables(std::vector<std::string> variables, Domain domain = {}) {
  domain.variables = std::move(variables);
  return domain;
}
// Domain of expressions that are evaluated over the node's input: d is its distance, t the position along its struts.
inline Domain over_child(Domain domain = {}) {
  domain = with_variables({"d", "t"}, std::move(domain));
  domain.child_attributes = true;
  return domain;
}

namespace unit {
inline const Domain mm = any("mm"), degrees = any("deg"), none = any();
inline const Domain point = in_space(InSpace::point, mm);
inline const Domain points = in_space(InSpace::point, from_to(-design_limit_mm, design_limit_mm, "mm"));
inline const Domain on_surface = in_space(InSpace::surface, from_to(-design_limit_mm, design_limit_mm, "mm"));
inline const Domain direction = in_space(InSpace::direction, none), offset = in_space(InSpace::offset, mm);
inline const Domain positive_mm = positive("mm"), not_negative_mm = not_negative("mm");
inline const Domain radius = in_space(InSpace::radius, positive_mm);
inline const Domain radius_or_none = in_space(InSpace::radius, not_negative_mm);
}  // namespace unit

}  // namespace ombre::design

// Combines the strut functions of all node families.
#include "nodes/common/struts.h"

#include "nodes/common/strut_families.h"

namespace ombre::nodes {

std::optional<std::array<double, 2>> end_radii(const design::Number& radius) {
  std::array<double, 2> radii{};
  if (const double* constant = radius.constant())
    radii.fill(*constant);
  else if (const auto linear = radius.expression()->linear_in("t"))
    radii = {linear->constant, linear->constant + linear->slope};
  return radii[0] > 0 && radii[1] > 0 ? std::optional(radii) : std::nullopt;
}

size_t strut_count(const design::Node& node) { return is_single_strut(node) ? 1 : lattice_strut_count(node); }

std::optional<std::vector<StrutShape>> struts_of(const design::Node& node) {
  if (!is_single_strut(node)) return lattice_struts(node);
  const auto strut = single_strut(node);
  return strut ? std::optional(std::vector{*strut}) : std::nullopt;
}

}  // namespace ombre::nodes

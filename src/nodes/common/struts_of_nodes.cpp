// Combines the strut functions of all node families.
#include "nodes/common/struts.h"

#include "nodes/common/strut_families.h"

namespace ombre::nodes {
namespace {

std::optional<StrutMaker> maker_of(const design::Node& node) {
  for (const auto family : {&single_strut, &lattice_struts, &point_struts})
    if (auto found = family(node)) return found;
  return std::nullopt;
}

}  // namespace

std::optional<std::array<double, 2>> end_radii(const design::Number& radius) {
  std::array<double, 2> radii{};
  if (const double* constant = radius.constant())
    radii.fill(*constant);
  else if (const auto linear = radius.expression()->linear_in("t"))
    radii = {linear->constant, linear->constant + linear->slope};
  return radii[0] > 0 && radii[1] > 0 ? std::optional(radii) : std::nullopt;
}

bool makes_struts(const design::Node& node) { return maker_of(node).has_value(); }

size_t strut_count(const design::Node& node) {
  const auto maker = maker_of(node);
  return maker ? maker->count : 0;
}

StrutsOrReason struts_of(const design::Node& node) {
  const auto maker = maker_of(node);
  return maker ? maker->make() : StrutsOrReason{};
}

}  // namespace ombre::nodes

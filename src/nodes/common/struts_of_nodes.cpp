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

bool uses_only_t(const expr::Expression& formula) {
  const auto start = [](const expr::Node& variable) -> std::optional<expr::Expression> {
    return variable.name == "t" ? std::optional(expr::Expression::constant(0)) : std::nullopt;
  };
  return formula.with_substitutes(start).constant_value().has_value();
}

}  // namespace

EndRadii end_radii(const design::Number& radius) {
  if (const double* constant = radius.constant()) return {std::array{*constant, *constant}};
  const expr::Expression& formula = *radius.expression();
  if (const auto linear = formula.linear_in("t")) {
    const std::array radii{linear->constant, linear->constant + linear->slope};
    if (radii[0] > 0 && radii[1] > 0) return {radii};
    return {{}, "the radius is not above 0 at both ends of the struts"};
  }
  return {{}, uses_only_t(formula) ? "the radius is not linear along the struts" : radius_varies_by_place};
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

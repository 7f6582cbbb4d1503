// Parameters that are numbers which may vary in space.
#include <algorithm>

#include "design/outputs.h"
#include "design/values.h"
#include "program/evaluate.h"

namespace ombre::design {

program::Field Number::at(const program::Point& p, const expr::Variables& extra) const {
  if (const double* value = constant()) return p.constant(*value);
  return expression()->lower(p, extra);
}

bool Number::uses_cell() const {
  return expression() && std::ranges::any_of(expr::cell_names(), [&](auto name) { return expression()->uses(name); });
}

Interval Number::range(const Box& where, const std::map<std::string_view, Interval>& extra) const {
  if (const double* value = constant()) return *value;
  program::Builder builder;
  const OutputsAlone outputs(builder, true);
  program::Point p = program::Point::origin_frame(builder);
  if (uses_cell() || !expression()->inputs().empty()) p.cell = {anything(p), anything(p), anything(p)};
  const auto known = [&](std::string_view name) -> std::optional<program::Field> {
    const auto it = extra.find(name);
    if (it == extra.end()) return std::nullopt;
    return min(max(anything(p), it->second.lo), p.constant(it->second.hi));
  };
  const program::Field field = expression()->lower(p, known);
  const program::Program program = builder.finish({{"value", field}});
  std::vector<Interval> values;
  program::evaluate_intervals(program, where, values);
  return values[program.outputs[0]];
}

}  // namespace ombre::design

#include "nodes/common/made_fields.h"

#include "design/registry.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"

namespace ombre::nodes {

using namespace design;
using program::Field, program::Point;

void add_nodes_of(const Number& number, std::vector<NodePtr>& roots) {
  if (!number.expression()) return;
  for (const NodePtr& node : nodes_of(*number.expression())) roots.push_back(node);
}

Field outside_of(Lowering& lowering, const SolidName& solid, const Point& p) {
  return solid.node->type().is_solid() ? lowering.distance(*solid.node, p)
                                       : lowering.answer(*solid.node, solid.output, p).numbers[0];
}

Box box_of(const SolidName& solid, const Box& where, double margin) {
  if (solid.node->type().is_solid()) return solid.node->bounds(where, margin);
  return intersect(solid.node->output_bounds(solid.output, where.expanded(margin)).expanded(margin), where);
}

MadeFields::MadeFields(const Reader& reader, const std::vector<NodePtr>& roots, const Box& box, const Make& make) {
  LoweringContext context(reader.materials, roots);
  program::Builder builder;
  Lowering lowering(context, builder);
  const std::vector<Field> fields = make(lowering, Point::origin_frame(builder));
  program::Outputs outputs;
  for (size_t n = 0; n < fields.size(); ++n) outputs.emplace_back(std::to_string(n), fields[n]);
  context.finish_bodies();
  const program::Program whole = program::inline_bodies(builder.finish(outputs));
  std::vector<Interval> ranges;
  evaluate_intervals(whole, box, ranges);
  program_ = program::expand_parts(whole, ranges, program::Precision::reference);
}

std::vector<double> MadeFields::at(Vec3 p, std::vector<double>& values) const {
  program::evaluate_point(program_, p, values);
  std::vector<double> found;
  for (const auto output : program_.outputs) found.push_back(values[output]);
  return found;
}

std::vector<double> MadeFields::at(Vec3 p) const {
  std::vector<double> values;
  return at(p, values);
}

std::vector<Interval> MadeFields::range(const Box& box) const {
  std::vector<Interval> all, found;
  evaluate_intervals(program_, box, all);
  for (const auto output : program_.outputs) found.push_back(all[output]);
  return found;
}

}  // namespace ombre::nodes

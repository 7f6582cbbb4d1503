// Outputs of value nodes as fields.
#include <algorithm>

#include "design/outputs.h"
#include "design/registry.h"

namespace ombre::design {
namespace {

// Represents an unknown value where only ranges are evaluated.
class Anything : public program::FieldSource {
 public:
  std::string name() const override { return "anything"; }
  Hash content() const override { return {}; }
  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view) const override { return 0; }
  double sample(int, Vec3) const override { return std::numeric_limits<double>::quiet_NaN(); }
};

}  // namespace

Field anything(const Point& p, const Interval& range) {
  const Field field = p.builder().source(std::make_shared<Anything>(), 0, p.x, p.y, p.z);
  return range.is_bounded() ? min(max(field, range.lo), p.constant(range.hi)) : field;
}

std::string NodeOutput::name() const {
  const std::string& own = node->type().outputs[output].name;
  return axis < 0 ? own : own + '.' + "xyz"[axis];
}

Field OutputsAlone::number(const NodeOutput& output, const Point& p) {
  const auto& [node, number, axis] = output;
  const OutputInfo& info = node->type().outputs[number];
  if (by_ranges_ && info.range.is_bounded()) return anything(p, info.range);
  const Key key{node.get(), number, p.x.id, p.y.id, p.z.id};
  if (const auto known = known_.find(key); known != known_.end()) return known->second[std::max(axis, 0)];
  const VectorField made = node->numbers(number, {Inputs(*node, nullptr), p});
  known_.emplace(key, made);
  return made[std::max(axis, 0)];
}

Field OutputInput::field(const Point& p) const {
  if (auto* fields = dynamic_cast<OutputFields*>(p.builder().user())) return fields->number(output_, p);
  return OutputsAlone(p.builder(), false).number(output_, p);
}

std::string OutputInput::name() const { return output_.node->type().name + '.' + output_.name(); }

bool OutputInput::is_same(const Input& other) const {
  const auto* output = dynamic_cast<const OutputInput*>(&other);
  return output && output->output_.node == output_.node && output->output_.output == output_.output &&
         output->output_.axis == output_.axis;
}

expr::Expression expression_of(NodeOutput output) {
  return expr::Expression::of_input(std::make_shared<OutputInput>(std::move(output)));
}

}  // namespace ombre::design

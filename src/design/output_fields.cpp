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

size_t first_or(int part) { return static_cast<size_t>(std::max(part, 0)); }

}  // namespace

Field anything(const Point& p, const Interval& range) {
  const Field field = p.builder().source(std::make_shared<Anything>(), 0, p.x, p.y, p.z);
  return range.is_bounded() ? min(max(field, range.lo), p.constant(range.hi)) : field;
}

Numbers4 select(Field flag, const Numbers4& yes, const Numbers4& no) {
  Numbers4 result = yes;
  for (size_t n = 0; n < result.size(); ++n)
    if (yes[n]) result[n] = program::select(flag, yes[n], no[n]);
  return result;
}

std::string_view name(OutputForm form) {
  constexpr std::array<std::string_view, 4> names{"numbers", "mixture", "solid", "constant"};
  return names[static_cast<size_t>(form)];
}

std::vector<Field> fields_of(const OutputAnswer& answer) {
  std::vector<Field> fields;
  for (const Field number : answer.numbers)
    if (number) fields.push_back(number);
  if (answer.composition)
    for (const auto& [id, fraction] : answer.composition->fractions) fields.push_back(fraction);
  return fields;
}

std::string NodeOutput::name() const {
  const OutputInfo& own = node->type().outputs[output];
  return part < 0 ? own.name : own.name + '.' + own.type.parts[static_cast<size_t>(part)];
}

Field OutputsAlone::number(const NodeOutput& output, const Point& p) {
  const auto& [node, number, part] = output;
  const OutputInfo& info = node->type().outputs[number];
  if (by_ranges_ && info.range.is_bounded()) return anything(p, info.range);
  const Key key{node.get(), number, p.x.id, p.y.id, p.z.id};
  if (const auto known = known_.find(key); known != known_.end()) return known->second[first_or(part)];
  const Numbers4 made = node->answer(number, {Inputs(*node, nullptr), p}).numbers;
  known_.emplace(key, made);
  return made[first_or(part)];
}

Field OutputInput::field(const Point& p) const {
  if (auto* fields = dynamic_cast<OutputFields*>(p.builder().user())) return fields->number(output_, p);
  return OutputsAlone(p.builder(), false).number(output_, p);
}

std::string OutputInput::name() const { return output_.node->type().name + '.' + output_.name(); }

bool OutputInput::is_same(const Input& other) const {
  const auto* output = dynamic_cast<const OutputInput*>(&other);
  return output && output->output_.node == output_.node && output->output_.output == output_.output &&
         output->output_.part == output_.part;
}

expr::Expression expression_of(NodeOutput output) {
  return expr::Expression::of_input(std::make_shared<OutputInput>(std::move(output)));
}

}  // namespace ombre::design

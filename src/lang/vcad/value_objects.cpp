#include "lang/vcad/value_objects.h"

#include <algorithm>
#include <cmath>

#include "base/system/not_copied.h"
#include "base/text/text.h"

namespace ombre::lang {
namespace {

using design::NodePtr;
using design::OutputForm;
using expr::Binary;
using expr::Expression;

// Longer formulas are turned into nodes, so that a part that is used repeatedly is stored once.
constexpr size_t longest_formula = 64;
constexpr uint64_t object_bytes = 1024;  // counted for each object, so that their number is limited

Value output_value(const NodePtr& node, size_t output, const ValueMaker& maker, Meter& meter);

class ValueObject final : public Object, NotCopied {
 public:
  ValueObject(NodePtr node, size_t output, std::optional<Expression> number, const ValueMaker& maker, Meter& meter)
      : node_(std::move(node)), output_(output), number_(std::move(number)), maker_(maker), meter_(meter) {
    meter_.claim_text(object_bytes);
  }
  ~ValueObject() override { meter_.release_text(object_bytes); }

  const std::optional<Expression>& number() const { return number_; }
  bool is_mixture() const { return node_ && node_->type().outputs[output_].type.form == OutputForm::mixture; }

  Form form() const override { return is_mixture() ? Form::mixture : number_ ? Form::value : Form::values; }
  std::string describe() const override;
  std::string text() const override;
  Data data() const override;
  std::optional<Value> part(const std::string& name, std::string& names, Meter& meter) const override;
  std::optional<Value> apply(std::string_view function, std::span<const Value> operands, Meter& meter) const override;

 private:
  Value of(Expression expression, Meter& meter) const;
  std::optional<Value> mixed(std::span<const Value> operands, Meter& meter) const;

  NodePtr node_;                      // null for a formula of several nodes
  size_t output_ = 0;                 // the output of the node that this stands for
  std::optional<Expression> number_;  // nothing if that output is not a number
  const ValueMaker& maker_;
  Meter& meter_;
};

const ValueObject* value_object(const Value& value) { return dynamic_cast<const ValueObject*>(value.object()); }

std::string ValueObject::describe() const {
  if (is_mixture()) return "a mixture of materials";
  if (number_) return "a value that varies in space";
  std::vector<std::string> names;
  for (const design::OutputInfo& output : node_->type().outputs) names.push_back(output.name);
  return "the values " + join(names, ", ") + " of " + node_->type().name;
}

std::string ValueObject::text() const { return number_ ? number_->text_with_names() : node_->type().name; }

Data ValueObject::data() const {
  if (node_ && output_ != node_->first_output()) return design::write_output({node_.get(), output_}, node_);
  if (node_) return Data(HostObjectPtr(std::make_shared<design::NodeObject>(node_)));
  return Data(HostObjectPtr(std::make_shared<design::FormulaObject>(*number_)));
}

std::optional<Value> ValueObject::part(const std::string& name, std::string& names, Meter& meter) const {
  if (!node_) {
    names = "a computed number has no parts";
    return std::nullopt;
  }
  for (size_t n = 0; n < node_->type().outputs.size(); ++n) {
    const design::OutputInfo& info = node_->type().outputs[n];
    if (!node_->gives(n)) continue;
    if (info.name != name) {
      names += (names.empty() ? "it has ." : ", .") + info.name;
      continue;
    }
    return output_value(node_, n, maker_, meter);
  }
  return std::nullopt;
}

Value ValueObject::of(Expression expression, Meter& meter) const {
  if (expression.size() > longest_formula) {
    const design::NodeType& type = *maker_.registry.find("formula");
    const HostObjectPtr written = std::make_shared<design::FormulaObject>(expression);
    Diagnostics diagnostics;
    const NodePtr node = design::make_node(type, {{&type.parameters[0], Data(written)}}, {},
                                           {maker_.materials, diagnostics, nullptr, {}, type.name, ""});
    if (!node) throw LimitReached{"values depend on one another too deeply", "compute them in fewer steps"};
    expression = design::expression_of({node, 0});
  }
  return ObjectPtr(std::make_shared<ValueObject>(nullptr, 0, std::move(expression), maker_, meter));
}

// Converts numbers, truth values and objects that are numbers.
std::optional<std::vector<Expression>> expressions_of(std::span<const Value> operands) {
  std::vector<Expression> list;
  for (const Value& operand : operands) {
    const ValueObject* object = value_object(operand);
    const double* number = operand.number();
    if (object && object->number())
      list.push_back(*object->number());
    else if (number && std::isfinite(*number))
      list.push_back(Expression::constant(*number));
    else if (operand.boolean())
      list.push_back(Expression::constant(*operand.boolean() ? 1 : 0));
    else
      return std::nullopt;
  }
  return list;
}

struct OperatorName {
  std::string_view name;
  Binary binary;
};

constexpr OperatorName operator_names[] = {
    {"+", Binary::add},          {"-", Binary::subtract},       {"*", Binary::multiply}, {"/", Binary::divide},
    {"%", Binary::mod},          {"^", Binary::power},          {"<", Binary::less},     {"<=", Binary::less_equal},
    {">", Binary::greater},      {">=", Binary::greater_equal}, {"==", Binary::equal},   {"!=", Binary::not_equal},
    {"&&", Binary::logical_and}, {"||", Binary::logical_or},    {"pow", Binary::power},
};

// Functions of scripts and the functions of formulas with the same meaning.
struct FunctionName {
  std::string_view name;
  const char* formula;
};

constexpr FunctionName function_names[] = {
    {"abs", "abs"},   {"sign", "sgn"}, {"floor", "floor"}, {"ceil", "ceil"}, {"round", "round"}, {"ln", "log"},
    {"log", "log10"}, {"exp", "exp"},  {"sqrt", "sqrt"},   {"min", "min"},   {"max", "max"},     {"clamp", "clamp"},
};

// Angles are in degrees in scripts, and in radians in formulas.
constexpr std::string_view takes_angle[] = {"sin", "cos", "tan"}, gives_angle[] = {"asin", "acos", "atan", "atan2"};

bool is_among(std::string_view name, std::span<const std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

Expression norm(const std::vector<Expression>& parts) {
  std::vector<Expression> squares;
  for (const Expression& part : parts)
    squares.push_back(Expression::binary(Binary::power, part, Expression::constant(2)));
  return Expression::call("sqrt", {Expression::call("sum", squares)});
}

std::optional<Expression> result(std::string_view function, const std::vector<Expression>& operands) {
  if (operands.size() == 3 && function == "?:") return Expression::conditional(operands[0], operands[1], operands[2]);
  if (operands.size() == 1 && function == "-") return Expression::negate(operands[0]);
  if (operands.size() == 1 && function == "+") return operands[0];
  if (operands.size() == 1 && function == "!") return Expression::logical_not(operands[0]);
  if (operands.size() == 2)
    for (const OperatorName& known : operator_names)
      if (known.name == function) return Expression::binary(known.binary, operands[0], operands[1]);
  const std::string name(function);
  if (is_among(function, takes_angle)) return Expression::call(name, {Expression::call("deg2rad", operands)});
  if (is_among(function, gives_angle)) return Expression::call("rad2deg", {Expression::call(name, operands)});
  if (function == "norm") return norm(operands);
  if (function == "log" && operands.size() == 2)  // log(base, x)
    return Expression::binary(Binary::divide, Expression::call("log", {operands[1]}),
                              Expression::call("log", {operands[0]}));
  for (const FunctionName& known : function_names)
    if (known.name == function) return Expression::call(known.formula, operands);
  return std::nullopt;
}

std::optional<Value> ValueObject::apply(std::string_view function, std::span<const Value> operands,
                                        Meter& meter) const {
  const auto expressions = expressions_of(operands);
  if (!expressions) return function == "?:" ? mixed(operands, meter) : std::nullopt;
  auto made = result(function, *expressions);
  return made ? std::optional(of(std::move(*made), meter)) : std::nullopt;
}

// Evaluates condition ? material : material.
std::optional<Value> ValueObject::mixed(std::span<const Value> operands, Meter& meter) const {
  const design::NodeType& type = *maker_.registry.find("mix");
  const auto data_of = [&](const Value& value) -> std::optional<Data> {
    if (value.text() && maker_.materials.find(value.text()->text)) return Data(value.text()->text);
    const ValueObject* object = value_object(value);
    return object && object->is_mixture() ? std::optional(object->data()) : std::nullopt;
  };
  const auto condition = expressions_of(operands.first(1));
  const auto yes = data_of(operands[1]), no = data_of(operands[2]);
  if (!condition || !yes || !no) return std::nullopt;
  const Expression share = Expression::logical_not(Expression::logical_not(condition->front()));
  const HostObjectPtr written = std::make_shared<design::FormulaObject>(share);
  Diagnostics diagnostics;
  const NodePtr node = design::make_node(
      type, {{&type.parameters[0], *no}, {&type.parameters[1], *yes}, {&type.parameters[2], Data(written)}}, {},
      {maker_.materials, diagnostics, nullptr, {}, type.name, ""});
  return node ? std::optional(value_of(node, maker_, meter)) : std::nullopt;
}

// A solid on which values are measured, or which is part of another solid.
class SolidObject final : public Object, NotCopied {
 public:
  SolidObject(NodePtr node, const ValueMaker& maker, Meter& meter)
      : node_(std::move(node)), maker_(maker), meter_(meter) {
    meter_.claim_text(object_bytes);
  }
  ~SolidObject() override { meter_.release_text(object_bytes); }

  Form form() const override { return Form::solid; }
  std::string describe() const override { return "a " + node_->type().name; }
  std::string text() const override { return node_->type().name; }
  Data data() const override { return Data(HostObjectPtr(std::make_shared<design::NodeObject>(node_))); }
  // Its parts are its outputs, and those of the solids inside it that vary in space.
  std::optional<Value> part(const std::string& name, std::string& names, Meter& meter) const override {
    const auto own = node_->type().output(name);
    if (own && node_->gives(*own) && node_->type().outputs[*own].type.form == OutputForm::constant)
      return from_data(node_->constant(*own), meter);
    const design::OutputType* type = node_->output_type(name);
    if (!type || type->form != OutputForm::numbers) {
      const std::vector<std::string> outputs = node_->output_names();
      names = outputs.empty() ? "values such as distance_to(s) are measured on it" : "it has ." + join(outputs, ", .");
      return std::nullopt;
    }
    const design::NodeType& output_of = *maker_.registry.find("output_of");
    Diagnostics diagnostics;
    const NodePtr node =
        design::make_node(output_of, {{&output_of.parameters[0], data()}, {&output_of.parameters[1], Data(name)}}, {},
                          {maker_.materials, diagnostics, nullptr, {}, output_of.name, ""});
    return node ? std::optional(output_value(node, node->first_output(), maker_, meter)) : std::nullopt;
  }
  std::optional<Value> apply(std::string_view, std::span<const Value>, Meter&) const override { return std::nullopt; }

 private:
  NodePtr node_;
  const ValueMaker& maker_;
  Meter& meter_;
};

// Returns the value of one output: a number, a list of the parts of several, plain data, a mixture, or a solid.
Value output_value(const NodePtr& node, size_t output, const ValueMaker& maker, Meter& meter) {
  const design::OutputType& type = node->type().outputs[output].type;
  if (type.form == OutputForm::constant) return from_data(node->constant(output), meter);
  if (type.form == OutputForm::solid) {
    const design::NodeType& solid_of = *maker.registry.find("solid_of");
    Diagnostics diagnostics;
    const Data given = design::write_output({node.get(), output}, node);
    const NodePtr made = design::make_node(solid_of, {{&solid_of.parameters[0], given}}, {},
                                           {maker.materials, diagnostics, nullptr, node->where(), solid_of.name, ""});
    if (!made) throw LimitReached{"values depend on one another too deeply", "compute them in fewer steps"};
    return solid_value(made, maker, meter);
  }
  if (type.has_parts()) {
    ListBuilder list(meter);
    for (size_t n = 0; n < type.parts.size(); ++n)
      list.push(ObjectPtr(std::make_shared<ValueObject>(
          nullptr, 0, design::expression_of({node, output, static_cast<int>(n)}), maker, meter)));
    return list.finish();
  }
  std::optional<Expression> number;
  if (type.is_number()) number = design::expression_of({node, output});
  // A number that is not the node's first output stands for itself, without the node's other outputs.
  const bool is_node = !number || output == node->first_output();
  return ObjectPtr(std::make_shared<ValueObject>(is_node ? node : nullptr, output, std::move(number), maker, meter));
}

}  // namespace

Value solid_value(const NodePtr& node, const ValueMaker& maker, Meter& meter) {
  return ObjectPtr(std::make_shared<SolidObject>(node, maker, meter));
}

// The value of several numbers is the node, whose parts are its outputs.
Value value_of(const NodePtr& node, const ValueMaker& maker, Meter& meter) {
  const size_t first = node->first_output();
  std::optional<Expression> number;
  if (node->type().outputs[first].type.is_number()) number = design::expression_of({node, first});
  return ObjectPtr(std::make_shared<ValueObject>(node, first, std::move(number), maker, meter));
}

namespace {

// Makes a node whose value is the formula.
Value formula_value(const Data& formula, const ValueMaker& maker, Meter& meter) {
  const design::NodeType& type = *maker.registry.find("formula");
  Diagnostics diagnostics;
  const NodePtr node = design::make_node(type, {{&type.parameters[0], formula}}, {},
                                         {maker.materials, diagnostics, nullptr, formula.where, type.name, ""});
  return node ? value_of(node, maker, meter) : Value();
}

const design::NodeObject* node_in(const Data& data) {
  return dynamic_cast<const design::NodeObject*>(data.host_object().get());
}

}  // namespace

Value host_value(const Data& data, const ValueMaker& maker, Meter& meter) {
  if (const design::NodeObject* object = node_in(data))
    return object->node()->type().is_solid() ? solid_value(object->node(), maker, meter)
                                             : value_of(object->node(), maker, meter);
  const DataMembers* members = data.members();
  const Data *from = members ? data.find("from") : nullptr, *output = members ? data.find("output") : nullptr;
  if (from && output && node_in(*from) && output->string())
    if (const auto number = node_in(*from)->node()->type().output(*output->string()))
      return output_value(node_in(*from)->node(), *number, maker, meter);
  if (data.host_object() || (members && data.find("formula"))) return formula_value(data, maker, meter);
  const DataList* list = data.list();
  if (!list) return from_data(data, meter);
  ListBuilder builder(meter);
  for (const Data& item : *list) builder.push(host_value(item, maker, meter));
  return builder.finish();
}

}  // namespace ombre::lang

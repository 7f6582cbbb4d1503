#include "expr/expression.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

#include "base/text/text.h"
#include "expr/expression_parser.h"
#include "expr/functions.h"

namespace ombre::expr {
namespace {

using program::Builder;
using program::Field;
using program::Op;
using program::Point;

constexpr size_t longest_remembered = 1024;  // longest formula in the cache, in characters

// Returns the value of a coordinate, or nothing if there is none of that name.
std::optional<Field> coordinate(std::string_view name, const Point& p) {
  Builder& builder = p.builder();
  if (name == "x") return p.x;
  if (name == "y") return p.y;
  if (name == "z") return p.z;
  if (name == "rho") return length(p.x, p.y);
  if (name == "r") return length(p.x, p.y, p.z);
  if (name == "phic" || name == "theta") return builder.apply(Op::atan2, p.y, p.x);
  if (name == "phis") {
    const Field r = length(p.x, p.y, p.z);
    const Field cosine = min(max(p.z / r, p.constant(-1)), p.constant(1));
    return select(r <= 0, p.constant(0), builder.apply(Op::acos, cosine));
  }
  for (size_t axis = 0; axis < 3; ++axis)
    if (name == cell_names()[axis] && p.cell[axis]) return p.cell[axis];
  return std::nullopt;
}

class Lowerer {
 public:
  Lowerer(const Point& p, const Variables& extra) : p_(p), extra_(extra) {}

  Field lower(const Node& node) {
    switch (node.kind) {
      case Kind::number:
        return p_.constant(node.number);
      case Kind::variable:
        return variable(node.name);
      case Kind::negate:
        return -lower(*node.operands[0]);
      case Kind::logical_not:
        return logical_not(lower(*node.operands[0]));
      case Kind::conditional: {
        const Field condition = lower(*node.operands[0]);
        const Field yes = lower(*node.operands[1]);
        return select(condition, yes, lower(*node.operands[2]));
      }
      case Kind::call: {
        std::vector<Field> arguments;
        for (const auto& operand : node.operands) arguments.push_back(lower(*operand));
        return find_function(node.name)->lower(arguments);
      }
      case Kind::source:
        return p_.builder().source(node.source, 0, p_.x, p_.y, p_.z);
      case Kind::input:
        return node.input->field(p_);
      case Kind::binary:
        break;
    }
    return chain(node);
  }

 private:
  Field variable(const std::string& name) {
    if (extra_)
      if (const auto field = extra_(name)) return *field;
    const auto field = coordinate(name, p_);
    // Unknown variables were reported before, but lowering still needs a value.
    return field ? *field : p_.constant(std::numeric_limits<double>::quiet_NaN());
  }

  // Lowers a + b + c + ... without recursion on the left operand, since sums may be long.
  Field chain(const Node& node) {
    std::vector<const Node*> links{&node};
    while (links.back()->operands[0]->kind == Kind::binary) links.push_back(links.back()->operands[0].get());
    Field value = lower(*links.back()->operands[0]);
    for (size_t i = links.size(); i-- > 0;) value = combine(links[i]->binary, value, lower(*links[i]->operands[1]));
    return value;
  }

  static Field combine(Binary binary, Field a, Field b) {
    switch (binary) {
      case Binary::add:
        return a + b;
      case Binary::subtract:
        return a - b;
      case Binary::multiply:
        return a * b;
      case Binary::divide:
        return a / b;
      case Binary::mod:
        return a.builder->apply(Op::mod, a, b);
      case Binary::power:
        return power(a, b);
      case Binary::less:
        return less(a, b);
      case Binary::less_equal:
        return less_equal(a, b);
      case Binary::greater:
        return less(b, a);
      case Binary::greater_equal:
        return less_equal(b, a);
      case Binary::equal:
        return a.builder->apply(Op::equal, a, b);
      case Binary::not_equal:
        return logical_not(a.builder->apply(Op::equal, a, b));
      case Binary::logical_and:
        return logical_and(a, b);
      case Binary::logical_or:
        return logical_or(a, b);
      case Binary::logical_xor:
        return logical_not(a.builder->apply(Op::equal, truth(a), truth(b)));
      case Binary::logical_nand:
        return logical_not(logical_and(a, b));
      case Binary::logical_nor:
        return logical_not(logical_or(a, b));
    }
    return a;
  }

  const Point& p_;
  const Variables& extra_;
};

// Visits all nodes in the order of the text.
template <class F>
void each_node(const Node& root, F f) {
  std::vector<const Node*> open{&root};
  while (!open.empty()) {
    const Node* node = open.back();
    open.pop_back();
    f(*node);
    for (size_t i = node->operands.size(); i-- > 0;) open.push_back(node->operands[i].get());
  }
}

template <class F>
void each_variable(const Node& root, F f) {
  each_node(root, [&](const Node& node) {
    if (node.kind == Kind::variable) f(node);
  });
}

std::shared_ptr<Node> make_node(Kind kind, std::vector<NodePtr> operands) {
  auto node = std::make_shared<Node>();
  node->kind = kind;
  node->operands = std::move(operands);
  return node;
}

bool contains(const std::vector<InputPtr>& inputs, const Input& input) {
  return std::ranges::any_of(inputs, [&](const InputPtr& known) { return known->is_same(input); });
}

// Replaces some variables of a tree by subtrees.
class Substitution {
 public:
  explicit Substitution(const std::function<NodePtr(const Node&)>& other) : other_(other) {}

  NodePtr of(const NodePtr& node) const {
    if (node->kind == Kind::variable) {
      NodePtr other = other_(*node);
      return other ? other : node;
    }
    if (node->operands.empty()) return node;
    return node->kind == Kind::binary ? of_chain(node) : over(*node, all(node->operands));
  }

 private:
  // Copies a + b + c + ... without recursion on the left operand, since sums may be long.
  NodePtr of_chain(const NodePtr& node) const {
    std::vector<NodePtr> links{node};
    while (links.back()->operands[0]->kind == Kind::binary) links.push_back(links.back()->operands[0]);
    NodePtr value = of(links.back()->operands[0]);
    for (size_t i = links.size(); i-- > 0;) value = over(*links[i], {value, of(links[i]->operands[1])});
    return value;
  }

  std::vector<NodePtr> all(const std::vector<NodePtr>& nodes) const {
    std::vector<NodePtr> result;
    for (const NodePtr& node : nodes) result.push_back(of(node));
    return result;
  }

  static NodePtr over(const Node& node, std::vector<NodePtr> operands) {
    auto copy = make_node(node.kind, std::move(operands));
    copy->binary = node.binary;
    copy->name = node.name;
    return copy;
  }

  const std::function<NodePtr(const Node&)>& other_;
};

// Returns the range of the text's own characters: in its file if the text occurs there literally, else in a source that
// consists of the text alone.
SourceRange text_range(const std::string& text, const SourceRange& where) {
  if (where.source && where.end - where.begin == text.size() &&
      where.source->text().substr(where.begin, text.size()) == text)
    return where;
  std::string name = "expression";
  if (where.source) {
    const Place place = where.source->place(where.begin);
    name = where.source->name() + ":" + std::to_string(place.line) + ": in the expression made here";
  }
  return {make_source(name, text), 0, static_cast<uint32_t>(text.size())};
}

}  // namespace

Node::~Node() {
  std::vector<std::shared_ptr<const Node>> open = std::move(operands);
  while (!open.empty()) {
    const std::shared_ptr<const Node> node = std::move(open.back());
    open.pop_back();
    if (node.use_count() != 1) continue;
    try {
      for (auto& operand : const_cast<Node&>(*node).operands) open.push_back(std::move(operand));
    } catch (const std::bad_alloc&) {  // NOLINT: without memory for the list, the other operands end by recursion
    }
  }
}

const std::vector<std::string>& coordinate_names() {
  static const std::vector<std::string> names{"x", "y", "z", "rho", "phic", "r", "theta", "phis", "ci", "cj", "ck"};
  return names;
}

const std::array<std::string_view, 3>& cell_names() {
  static constexpr std::array<std::string_view, 3> names{"ci", "cj", "ck"};
  return names;
}

std::vector<FunctionInfo> function_table() {
  std::vector<FunctionInfo> table;
  for (const Function& function : functions()) table.push_back({function.name, function.arguments, function.meaning});
  return table;
}

std::optional<Expression> Expression::parse(const std::string& text, const SourceRange& where,
                                            Diagnostics& diagnostics) {
  // Caches recent formulas, since loops make the same few again and again.
  struct Known {
    std::string text;
    std::optional<Expression> expression;
  };
  thread_local std::array<Known, 64> recent;
  Known& known = recent[std::hash<std::string>()(text) % recent.size()];
  if (known.expression && known.text == text) return known.expression;
  auto root = parse_tree(text, text_range(text, where), diagnostics);
  if (!root) return std::nullopt;
  std::string canonical = print_tree(*root);
  Expression expression(std::move(root), std::move(canonical));
  if (text.size() <= longest_remembered) known = {text, expression};
  return expression;
}

Expression Expression::constant(double value) {
  auto node = std::make_shared<Node>();
  node->number = std::abs(value);
  // Represents the sign as a negation, as the parser does.
  if (std::signbit(value)) node = make_node(Kind::negate, {node});
  return {std::move(node), format_number(value)};
}

Expression Expression::of_source(const program::SourceField& source) {
  auto node = std::make_shared<Node>();
  node->kind = Kind::source;
  node->source = source;
  return {std::move(node), source->name() + " #" + source->content().hex()};
}

Expression::Expression(NodePtr root) {
  Parsed parsed{std::move(root), {}};
  each_node(*parsed.root, [&](const Node& node) {
    ++parsed.size;
    if (node.input && !contains(parsed.inputs, *node.input)) parsed.inputs.push_back(node.input);
  });
  parsed_ = std::make_shared<const Parsed>(std::move(parsed));
  std::string text = print_tree(this->root(), [&](const Input& input) {
    for (size_t i = 0; i < inputs().size(); ++i)
      if (inputs()[i]->is_same(input)) return input_name(i);
    return input.name();
  });
  parsed_ = std::make_shared<const Parsed>(Parsed{parsed_->root, std::move(text), parsed_->inputs, parsed_->size});
}

std::string Expression::input_name(size_t i) const { return inputs().size() == 1 ? "v" : "v" + std::to_string(i + 1); }

std::string Expression::text_with_names() const { return inputs().empty() ? text() : print_tree(root()); }

bool Expression::operator==(const Expression& other) const {
  if (parsed_ == other.parsed_) return true;
  const auto is_same = [](const InputPtr& a, const InputPtr& b) { return a->is_same(*b); };
  return text() == other.text() && std::ranges::equal(inputs(), other.inputs(), is_same);
}

Expression Expression::of_input(InputPtr input) {
  auto node = make_node(Kind::input, {});
  node->input = std::move(input);
  return Expression(NodePtr(std::move(node)));
}

Expression Expression::negate(const Expression& a) {
  return Expression(NodePtr(make_node(Kind::negate, {a.parsed_->root})));
}

Expression Expression::logical_not(const Expression& a) {
  return Expression(NodePtr(make_node(Kind::logical_not, {a.parsed_->root})));
}

Expression Expression::binary(Binary binary, const Expression& a, const Expression& b) {
  auto node = make_node(Kind::binary, {a.parsed_->root, b.parsed_->root});
  node->binary = binary;
  return Expression(NodePtr(std::move(node)));
}

Expression Expression::call(const std::string& function, const std::vector<Expression>& arguments) {
  std::vector<NodePtr> operands;
  for (const Expression& argument : arguments) operands.push_back(argument.parsed_->root);
  auto node = make_node(Kind::call, std::move(operands));
  node->name = function;
  return Expression(NodePtr(std::move(node)));
}

Expression Expression::conditional(const Expression& condition, const Expression& yes, const Expression& no) {
  return Expression(
      NodePtr(make_node(Kind::conditional, {condition.parsed_->root, yes.parsed_->root, no.parsed_->root})));
}

Expression Expression::with_substitutes(const Substitutes& other) const {
  bool changes = false;
  const auto root_of = [&](const Node& variable) -> NodePtr {
    const auto expression = other(variable);
    changes = changes || expression;
    return expression ? expression->parsed_->root : nullptr;
  };
  NodePtr made = Substitution(root_of).of(parsed_->root);
  return changes ? Expression(std::move(made)) : *this;
}

bool Expression::check_variables(const std::vector<std::string>& known, const std::string& text,
                                 const SourceRange& where, Diagnostics& diagnostics) const {
  bool all_known = true;
  each_variable(root(), [&](const Node& node) {
    for (const std::string& name : known)
      if (name == node.name) return;
    all_known = false;
    std::string hint = did_you_mean(node.name, known);
    if (node.name == "d") hint = "d, the distance of the child, is known in fgrade, material and attribute";
    if (hint.empty()) hint = "known here are " + join(known, ", ");
    diagnostics.error(Code::unknown_variable, place(node, text, where),
                      "there is no variable \"" + node.name + "\" in this expression", hint, {{"name", node.name}});
  });
  return all_known;
}

SourceRange Expression::place(const Node& variable, const std::string& text, const SourceRange& where) {
  return text_range(text, where).part(variable.begin, variable.end);
}

bool Expression::uses(std::string_view variable) const {
  bool found = false;
  each_variable(root(), [&](const Node& node) { found = found || node.name == variable; });
  return found;
}

namespace {

std::optional<double> constant_of(const Node& node) {
  bool varies = false;
  each_node(node,
            [&](const Node& part) { varies = varies || part.kind == Kind::variable || part.source || part.input; });
  if (varies) return std::nullopt;
  Builder builder;
  const Point p = Point::origin_frame(builder);
  const Variables none;
  return builder.constant_value(Lowerer(p, none).lower(node));
}

using Linear = Expression::Linear;

std::optional<Linear> combine_linear(Binary binary, Linear a, Linear b) {
  if (binary == Binary::add) return Linear{a.constant + b.constant, a.slope + b.slope};
  if (binary == Binary::subtract) return Linear{a.constant - b.constant, a.slope - b.slope};
  if (binary == Binary::multiply && b.slope == 0) return Linear{a.constant * b.constant, a.slope * b.constant};
  if (binary == Binary::multiply && a.slope == 0) return Linear{a.constant * b.constant, a.constant * b.slope};
  if (binary == Binary::divide && b.slope == 0) return Linear{a.constant / b.constant, a.slope / b.constant};
  return std::nullopt;
}

std::optional<Linear> linear(const Node& node, std::string_view variable);

// Handles a + b + c + ... without recursion on the left operand, since sums may be long.
std::optional<Linear> linear_chain(const Node& node, std::string_view variable) {
  std::vector<const Node*> links{&node};
  while (links.back()->operands[0]->kind == Kind::binary) links.push_back(links.back()->operands[0].get());
  std::optional<Linear> value = linear(*links.back()->operands[0], variable);
  for (size_t i = links.size(); i-- > 0 && value;) {
    const auto next = linear(*links[i]->operands[1], variable);
    value = next ? combine_linear(links[i]->binary, *value, *next) : std::nullopt;
  }
  return value;
}

std::optional<Linear> linear(const Node& node, std::string_view variable) {
  switch (node.kind) {
    case Kind::number:
      return Linear{node.number, 0};
    case Kind::variable:
      return node.name == variable ? std::optional(Linear{0, 1}) : std::nullopt;
    case Kind::negate: {
      const auto value = linear(*node.operands[0], variable);
      return value ? std::optional(Linear{-value->constant, -value->slope}) : std::nullopt;
    }
    case Kind::binary:
      return linear_chain(node, variable);
    default: {
      const auto constant = constant_of(node);
      return constant ? std::optional(Linear{*constant, 0}) : std::nullopt;
    }
  }
}

}  // namespace

std::optional<double> Expression::constant_value() const { return constant_of(root()); }

std::optional<Expression::Linear> Expression::linear_in(std::string_view variable) const {
  return linear(root(), variable);
}

Field Expression::lower(const Point& p, const Variables& extra) const { return Lowerer(p, extra).lower(root()); }

}  // namespace ombre::expr

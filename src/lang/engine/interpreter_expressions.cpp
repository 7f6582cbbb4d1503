// Expressions without calls.
#include <cmath>

#include "base/text/utf8.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

using ast::Expr;

Value Interpreter::eval(const Expr& expr, const ScopePtr& scope) {
  switch (expr.kind) {
    case Expr::Kind::undef:
      return {};
    case Expr::Kind::boolean:
      return static_cast<const ast::Boolean&>(expr).value;
    case Expr::Kind::number:
      return static_cast<const ast::Number&>(expr).value;
    case Expr::Kind::variable:
      return eval_variable(static_cast<const ast::Variable&>(expr).name, *scope);
    default:
      return eval_branching(expr, scope);
  }
}

Value Interpreter::eval_branching(const Expr& expr, const ScopePtr& scope) {
  const bool may_call =
      expr.kind == Expr::Kind::call || expr.kind == Expr::Kind::conditional || expr.kind == Expr::Kind::prefix;
  const Level level(*this, expr.span, may_call ? heavy : 1);
  switch (expr.kind) {
    case Expr::Kind::string: {
      const auto& literal = static_cast<const ast::String&>(expr);
      return TextPtr(std::make_shared<const Text>(literal.value, &literal, meter_));
    }
    case Expr::Kind::range:
      return eval_range(static_cast<const ast::Range&>(expr), scope);
    case Expr::Kind::list:
      return eval_list(static_cast<const ast::List&>(expr), scope);
    case Expr::Kind::unary:
      return eval_unary(static_cast<const ast::Unary&>(expr), scope);
    case Expr::Kind::chain:
      return eval_chain(static_cast<const ast::Chain&>(expr), scope);
    case Expr::Kind::power:
      return eval_power(static_cast<const ast::Power&>(expr), scope);
    case Expr::Kind::index:
      return eval_index(static_cast<const ast::Index&>(expr), scope);
    case Expr::Kind::member:
      return eval_member(static_cast<const ast::Member&>(expr), scope);
    case Expr::Kind::function:
      return eval_function(static_cast<const ast::Function&>(expr), scope);
    default:
      return eval_tail(expr, scope);
  }
}

// Returns the value of a name, or null without a diagnostic.
const Value* Interpreter::quiet_variable(Symbol name, const Scope& scope) {
  if (name->front() == '$')
    if (const Value* value = find_special(name)) return value;
  if (const Value* value = scope.find(name)) return value;
  if (const auto found = constants_.find(name); found != constants_.end()) return &found->second;
  if (no_constants_.count(name)) return nullptr;
  if (const auto data = vocabulary_.constant(*name)) return &(constants_[name] = from_data(*data, meter_));
  no_constants_.insert(name);
  return nullptr;
}

Value Interpreter::eval_variable(const ast::Name& name, const Scope& scope) {
  const Value* value = quiet_variable(name.symbol, scope);
  if (!value) fail_unknown_variable(name, scope);
  if (value->is_broken()) throw Failure{};
  return *value;
}

double Interpreter::number(const Expr& expr, const ScopePtr& scope, const char* what) {
  const Value value = eval(expr, scope);
  const double* number = value.number();
  if (!number) fail_found(expr.span, what, value);
  if (!std::isfinite(*number)) fail_found(expr.span, what, value);
  return *number;
}

Value Interpreter::eval_range(const ast::Range& range, const ScopePtr& scope) {
  const double begin = number(*range.begin, scope, "a range needs a finite number as its start");
  const double step = range.step ? number(*range.step, scope, "a range needs a finite number as its step") : 1;
  const double end = number(*range.end, scope, "a range needs a finite number as its end");
  if (step == 0) fail(range.step->span, "the step of a range cannot be 0");
  return RangePtr(std::make_shared<const Range>(Range{begin, step, end}));
}

Value Interpreter::eval_list(const ast::List& list, const ScopePtr& scope) {
  ListBuilder result(meter_);
  if (list.has_generators) {
    for (const ast::ExprPtr& element : list.elements) generate(*element, scope, result);
    return result.finish();
  }
  result.reserve(list.elements.size());
  for (const ast::ExprPtr& element : list.elements) result.push(eval(*element, scope));
  return result.finish(&list);
}

Value Interpreter::eval_unary(const ast::Unary& unary, const ScopePtr& scope) {
  return this->unary(unary.op, unary.span, eval(*unary.operand, scope));
}

Value Interpreter::unary(ast::Operator op, const ast::Span& where, const Value& operand) {
  try {
    return apply(op, operand, meter_);
  } catch (const Mismatch& mismatch) {
    fail_operator(op, where, operand, operand, mismatch);
  }
}

bool Interpreter::holds(const Expr& condition, const ScopePtr& scope) {
  const Value value = eval(condition, scope);
  if (value.object())
    fail(condition.span, "a condition must be known before the job runs, found " + describe(value),
         "write c ? a : b in an expression, which chooses at each point");
  return is_true(value);
}

Value Interpreter::eval_chain(const ast::Chain& chain, const ScopePtr& scope) {
  const ast::Operator first = chain.links.front().op;
  if (first == ast::Operator::logical_and || first == ast::Operator::logical_or) return eval_logic(chain, scope);
  Value value = eval(*chain.first, scope);
  for (const ast::Chain::Link& link : chain.links)
    value = binary(link.op, link.op_span, value, eval(*link.operand, scope));
  return value;
}

Value Interpreter::eval_logic(const ast::Chain& chain, const ScopePtr& scope) {
  const ast::Operator op = chain.links.front().op;
  const bool decisive = op == ast::Operator::logical_or;
  Value varying;  // combination of the operands that vary in space
  const auto is_decided_by = [&](const Expr& operand) {
    Value value = eval(operand, scope);
    if (!value.object()) return is_true(value) == decisive;
    // Negates twice, which turns any number into a truth value.
    value = unary(ast::Operator::logical_not, operand.span, unary(ast::Operator::logical_not, operand.span, value));
    varying = varying.is_undef() ? value : binary(op, operand.span, varying, value);
    return false;
  };
  if (is_decided_by(*chain.first)) return decisive;
  for (const ast::Chain::Link& link : chain.links)
    if (is_decided_by(*link.operand)) return decisive;
  return varying.is_undef() ? Value(!decisive) : varying;
}

Value Interpreter::eval_power(const ast::Power& power, const ScopePtr& scope) {
  const Value base = eval(*power.base, scope);
  return binary(ast::Operator::power, power.op_span, base, eval(*power.exponent, scope));
}

Value Interpreter::binary(ast::Operator op, const ast::Span& where, const Value& left, const Value& right) {
  at_ = where;
  try {
    return apply(op, left, right, meter_);
  } catch (const Mismatch& mismatch) {
    fail_operator(op, where, left, right, mismatch);
  }
}

Value Interpreter::eval_index(const ast::Index& index, const ScopePtr& scope) {
  const Value base = eval(*index.base, scope);
  const Value at = eval(*index.index, scope);
  const double* number = at.number();
  if (!number) fail_found(index.index->span, "an index needs to be a number", at);
  const double place = std::trunc(*number);
  const auto is_within = [&](size_t size) { return place >= 0 && place < static_cast<double>(size); };
  if (const List* list = base.list())
    return is_within(list->items.size()) ? list->items[static_cast<size_t>(place)] : Value();
  if (const Range* range = base.range()) {
    const double parts[] = {range->begin, range->step, range->end};
    return is_within(3) ? Value(parts[static_cast<size_t>(place)]) : Value();
  }
  const Text* text = base.text();
  if (!text) fail_found(index.base->span, "only lists, strings and ranges have an index", base);
  if (!is_within(text->text.size())) return {};
  size_t byte = 0;
  for (double skip = place; skip > 0 && byte < text->text.size(); --skip) {
    meter_.spend();
    byte += std::max<size_t>(1, code_point_size(text->text, byte));
  }
  if (byte >= text->text.size()) return {};
  return make_text(text->text.substr(byte, std::max<size_t>(1, code_point_size(text->text, byte))), meter_);
}

Value Interpreter::eval_member(const ast::Member& member, const ScopePtr& scope) {
  const Value base = eval(*member.base, scope);
  const std::string& name = member.member.text();
  if (const Object* object = base.object()) {
    std::string known;
    if (auto part = object->part(name, known, meter_)) return *part;
    fail(member.member.span, describe(base) + " has no \"." + name + '"', known);
  }
  const size_t place = name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : 3;
  if (place == 3) fail(member.member.span, "a vector has the parts .x, .y and .z only");
  const List* list = base.list();
  if (!list) fail_found(member.base->span, "only vectors have the parts .x, .y and .z", base);
  return place < list->items.size() ? list->items[place] : Value();
}

Value Interpreter::eval_function(const ast::Function& function, const ScopePtr& scope) {
  captured_.add(scope);
  return ClosurePtr(std::make_shared<const Closure>(Closure{&function, scope}));
}

}  // namespace ombre::lang

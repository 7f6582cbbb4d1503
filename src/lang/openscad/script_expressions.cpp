// Expressions without calls.
#include <cmath>

#include "base/text/utf8.h"
#include "lang/openscad/ranges.h"
#include "lang/openscad/script_evaluator.h"

namespace ombre::lang::openscad {

using ast::Expr;

Value Evaluator::eval(const Expr& expr, const ScopePtr& scope) {
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
      return eval_compound(expr, scope);
  }
}

Value Evaluator::eval_compound(const Expr& expr, const ScopePtr& scope) {
  const Level level(*this);
  if (depth_ > options_.limits.depth) stop("Expressions are nested too deeply", expr.span);
  at_ = expr.span;
  meter_.spend();
  switch (expr.kind) {
    case Expr::Kind::string: {
      const auto& string = static_cast<const ast::String&>(expr);
      return TextPtr(std::make_shared<const Text>(string.value, &string, meter_));
    }
    case Expr::Kind::range:
      return eval_range(static_cast<const ast::Range&>(expr), scope);
    case Expr::Kind::list:
      return eval_list(static_cast<const ast::List&>(expr), scope);
    case Expr::Kind::unary: {
      const auto& operation = static_cast<const ast::Unary&>(expr);
      const Value operand = eval(*operation.operand, scope);
      if (auto made = of_objects(ast::spelling(operation.op), {operand})) return *made;
      Problems problems;
      Value result = unary(operation.op, operand, meter_, problems);
      warn_all(problems, expr.span);
      return result;
    }
    case Expr::Kind::chain:
      return eval_chain(static_cast<const ast::Chain&>(expr), scope);
    case Expr::Kind::power: {
      const auto& power = static_cast<const ast::Power&>(expr);
      const Value base = eval(*power.base, scope);
      return operate(ast::Operator::power, base, eval(*power.exponent, scope), expr.span);
    }
    case Expr::Kind::index:
      return eval_index(static_cast<const ast::Index&>(expr), scope);
    case Expr::Kind::member:
      return eval_member(static_cast<const ast::Member&>(expr), scope);
    case Expr::Kind::function:
      captured_.add(scope);
      return ClosurePtr(std::make_shared<const Closure>(Closure{&static_cast<const ast::Function&>(expr), scope}));
    default:
      return eval_tail(expr, scope);
  }
}

// Returns the value of a name, or null without a message.
const Value* Evaluator::find_variable(Symbol name, const Scope& scope) const {
  if (name->front() == '$')
    if (const Value* value = find_special(name)) return value;
  if (const Value* value = scope.find(name)) return value;
  const auto constant = constants_.find(name);
  return constant == constants_.end() ? nullptr : &constant->second;
}

Value Evaluator::eval_variable(const ast::Name& name, const Scope& scope) {
  if (const Value* value = find_variable(name.symbol, scope)) return *value;
  warn("Ignoring unknown variable '" + name.text() + '\'', name.span);
  return {};
}

Value Evaluator::eval_range(const ast::Range& range, const ScopePtr& scope) {
  const Value first = eval(*range.begin, scope);
  const Value middle = range.step ? eval(*range.step, scope) : Value(1.0);
  const Value last = eval(*range.end, scope);
  if (!first.number() || !middle.number() || !last.number()) return {};
  Range result{*first.number(), *middle.number(), *last.number()};
  if (!range.step) {
    if (result.end < result.begin) {
      std::swap(result.begin, result.end);
      say(Message::Kind::deprecated,
          "Using ranges of the form [begin:end] with begin value greater than the end value is deprecated", range.span);
    }
  } else if (result.step > 0 && result.end < result.begin) {
    warn("begin is greater than the end, but step is positive", range.span);
  } else if (result.step < 0 && result.end > result.begin) {
    warn("begin is smaller than the end, but step is negative", range.span);
  }
  return RangePtr(std::make_shared<const Range>(result));
}

Value Evaluator::eval_list(const ast::List& list, const ScopePtr& scope) {
  ListBuilder result(meter_);
  if (list.has_generators) {
    for (const ast::ExprPtr& element : list.elements) generate(*element, scope, result);
  } else {
    result.reserve(list.elements.size());
    for (const ast::ExprPtr& element : list.elements) result.push(eval(*element, scope));
  }
  return result.finish(list.has_generators ? nullptr : &list);
}

Value Evaluator::operate(ast::Operator op, const Value& left, const Value& right, const ast::Span& where) {
  if (left.number() && right.number()) {  // a shortcut for the most frequent operators
    const double a = *left.number(), b = *right.number();
    if (op == ast::Operator::add) return a + b;
    if (op == ast::Operator::subtract) return a - b;
    if (op == ast::Operator::multiply) return a * b;
  }
  at_ = where;
  if (left.object() || right.object())
    if (auto made = of_objects(ast::spelling(op), {left, right})) return *made;
  Problems problems;
  Value result = binary(op, left, right, meter_, problems);
  warn_all(problems, where);
  return result;
}

Value Evaluator::eval_chain(const ast::Chain& chain, const ScopePtr& scope) {
  const ast::Operator first = chain.links.front().op;
  Value value = eval(*chain.first, scope);
  if (first == ast::Operator::logical_and || first == ast::Operator::logical_or) {
    const bool decisive = first == ast::Operator::logical_or;
    for (const ast::Chain::Link& link : chain.links) {
      if (!value.object() && truth(value) == decisive) return decisive;
      const Value next = eval(*link.operand, scope);
      value = value.object() || next.object() ? operate(link.op, value, next, chain.span) : next;
    }
    return value.object() ? value : Value(truth(value));
  }
  for (const ast::Chain::Link& link : chain.links)
    value = operate(link.op, value, eval(*link.operand, scope), chain.span);
  return value;
}

Value Evaluator::at_index(const Value& base, double index) {
  const double place = std::trunc(index);
  const auto is_within = [&](size_t size) { return place >= 0 && place < static_cast<double>(size); };
  if (const List* list = base.list())
    return is_within(list->items.size()) ? list->items[static_cast<size_t>(place)] : Value();
  if (const Range* range = base.range()) {
    const std::array<double, 3> parts{range->begin, range->step, range->end};
    return is_within(parts.size()) ? Value(parts[static_cast<size_t>(place)]) : Value();
  }
  const Text* text = base.text();
  if (!text || !is_within(text->text.size())) return {};
  size_t byte = 0;
  for (double skip = place; skip > 0 && byte < text->text.size(); --skip) {
    meter_.spend();
    byte += std::max<size_t>(1, code_point_size(text->text, byte));
  }
  if (byte >= text->text.size()) return {};
  return make_text(text->text.substr(byte, std::max<size_t>(1, code_point_size(text->text, byte))), meter_);
}

Value Evaluator::eval_index(const ast::Index& index, const ScopePtr& scope) {
  const Value base = eval(*index.base, scope);
  const Value at = eval(*index.index, scope);
  return at.number() ? at_index(base, *at.number()) : Value();
}

Value Evaluator::eval_member(const ast::Member& member, const ScopePtr& scope) {
  const Value base = eval(*member.base, scope);
  const std::string& name = member.member.text();
  if (const Object* object = base.object()) {
    std::string names;
    if (auto part = object->part(name, names, meter_)) return *part;
    stop("there is no ." + name + "; " + names, member.span);
  }
  if (base.list() && name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') return at_index(base, name[0] - 'x');
  const Range* range = base.range();
  if (range && name == "begin") return range->begin;
  if (range && name == "step") return range->step;
  if (range && name == "end") return range->end;
  return {};
}

}  // namespace ombre::lang::openscad

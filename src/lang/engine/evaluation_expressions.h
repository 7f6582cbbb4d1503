// Expressions without calls.
#pragma once

#include <cmath>

#include "base/text/utf8.h"
#include "lang/engine/evaluation.h"

namespace ombre::lang {

template <class Language, class Product>
Value Evaluation<Language, Product>::eval(const ast::Expr& expr, const ScopePtr& scope) {
  switch (expr.kind) {
    case ast::Expr::Kind::undef:
      return {};
    case ast::Expr::Kind::boolean:
      return static_cast<const ast::Boolean&>(expr).value;
    case ast::Expr::Kind::number:
      return static_cast<const ast::Number&>(expr).value;
    case ast::Expr::Kind::variable:
      return eval_variable(static_cast<const ast::Variable&>(expr).name, *scope);
    default:
      return eval_compound(expr, scope);
  }
}

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_compound(const ast::Expr& expr, const ScopePtr& scope) {
  using Kind = ast::Expr::Kind;
  const bool may_call = expr.kind == Kind::call || expr.kind == Kind::conditional || expr.kind == Kind::prefix;
  const auto level = deeper(expr.span, may_call ? Language::rules.call_levels : 1);
  switch (expr.kind) {
    case Kind::string: {
      const auto& literal = static_cast<const ast::String&>(expr);
      return TextPtr(std::make_shared<const Text>(literal.value, &literal, meter_));
    }
    case Kind::range:
      return self().eval_range(static_cast<const ast::Range&>(expr), scope);
    case Kind::list:
      return eval_list(static_cast<const ast::List&>(expr), scope);
    case Kind::unary: {
      const auto& operation = static_cast<const ast::Unary&>(expr);
      return self().unary(operation.op, expr.span, eval(*operation.operand, scope));
    }
    case Kind::chain:
      return eval_chain(static_cast<const ast::Chain&>(expr), scope);
    case Kind::power: {
      const auto& power = static_cast<const ast::Power&>(expr);
      const Value base = eval(*power.base, scope);
      return self().binary(ast::Operator::power, place(expr.span, power.op_span), base, eval(*power.exponent, scope));
    }
    case Kind::index:
      return eval_index(static_cast<const ast::Index&>(expr), scope);
    case Kind::member:
      return eval_member(static_cast<const ast::Member&>(expr), scope);
    case Kind::function:
      captured_.add(scope);
      return ClosurePtr(std::make_shared<const Closure>(Closure{&static_cast<const ast::Function&>(expr), scope}));
    default:
      return self().computed(expr, eval_tail(expr, scope));
  }
}

// Returns the value of a name, or null without a message.
template <class Language, class Product>
const Value* Evaluation<Language, Product>::find_variable(Symbol name, const Scope& scope) {
  if (name->front() == '$')
    if (const Value* value = find_special(name)) return value;
  if (const Value* value = scope.find(name)) return value;
  const auto constant = constants_.find(name);
  return constant == constants_.end() ? self().find_constant(name) : &constant->second;
}

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_variable(const ast::Name& name, const Scope& scope) {
  const Value* value = find_variable(name.symbol, scope);
  if (!value) return self().value_of_unknown(name, scope);
  if (value->is_broken()) throw Stopped{};
  return *value;
}

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_list(const ast::List& list, const ScopePtr& scope) {
  ListBuilder result(meter_);
  if (list.has_generators) {
    for (const ast::ExprPtr& element : list.elements) generate(*element, scope, result);
    return result.finish();
  }
  result.reserve(list.elements.size());
  for (const ast::ExprPtr& element : list.elements) result.push(eval(*element, scope));
  return result.finish(&list);
}

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_chain(const ast::Chain& chain, const ScopePtr& scope) {
  const ast::Operator first = chain.links.front().op;
  if (first == ast::Operator::logical_and || first == ast::Operator::logical_or) return eval_logic(chain, scope);
  Value value = eval(*chain.first, scope);
  for (const ast::Chain::Link& link : chain.links)
    value = self().binary(link.op, place(chain.span, link.op_span), value, eval(*link.operand, scope));
  return value;
}

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_logic(const ast::Chain& chain, const ScopePtr& scope) {
  const ast::Operator op = chain.links.front().op;
  const bool decisive = op == ast::Operator::logical_or;
  Value varying;  // combination of the operands that vary in space
  const auto is_decided_by = [&](const ast::Expr& operand) {
    Value value = eval(operand, scope);
    if (!value.object()) return is_true(value) == decisive;
    // Negates twice, which turns any number into a truth value.
    for (int n = 0; n < 2; ++n) value = self().unary(ast::Operator::logical_not, operand.span, value);
    varying = varying.is_undef() ? value : self().binary(op, operand.span, varying, value);
    return false;
  };
  if (is_decided_by(*chain.first)) return decisive;
  for (const ast::Chain::Link& link : chain.links)
    if (is_decided_by(*link.operand)) return decisive;
  return varying.is_undef() ? Value(!decisive) : varying;
}

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_index(const ast::Index& index, const ScopePtr& scope) {
  const Value base = eval(*index.base, scope);
  const Value at = eval(*index.index, scope);
  if (base.record() && at.text()) {
    const Value* member = base.record()->find(at.text()->text);
    return member ? *member : Value();
  }
  const double* number = at.number();
  if (!number) return self().mistaken(index.index->span, "an index needs to be a number", at);
  const double place = std::trunc(*number);
  const auto is_within = [&](size_t size) { return place >= 0 && place < static_cast<double>(size); };
  if (const List* list = base.list())
    return is_within(list->items.size()) ? list->items[static_cast<size_t>(place)] : Value();
  if (const Range* range = base.range()) {
    const double parts[] = {range->begin, range->step, range->end};
    return is_within(3) ? Value(parts[static_cast<size_t>(place)]) : Value();
  }
  const Text* text = base.text();
  if (!text) return self().mistaken(index.base->span, "only lists, strings and ranges have an index", base);
  return is_within(text->text.size()) ? character(text->text, place) : Value();
}

template <class Language, class Product>
Value Evaluation<Language, Product>::character(const std::string& text, double index) {
  const auto size_at = [&](size_t byte) { return character_size(text, byte); };
  size_t byte = 0;
  for (double skip = index; skip > 0 && byte < text.size(); --skip) {
    meter_.spend();
    byte += size_at(byte);
  }
  return byte < text.size() ? make_text(text.substr(byte, size_at(byte)), meter_) : Value();
}

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_member(const ast::Member& member, const ScopePtr& scope) {
  const Value base = eval(*member.base, scope);
  const std::string& name = member.member.text();
  if (const Object* object = base.object()) {
    std::string known;
    if (auto part = object->part(name, known, meter_)) return *part;
    self().stop_without_part(member, *object, known);
  }
  const List* list = base.list();
  if (!list || name.size() != 1 || name[0] < 'x' || name[0] > 'z') return self().eval_other_member(member, base);
  const auto place = static_cast<size_t>(name[0] - 'x');
  return place < list->items.size() ? list->items[place] : Value();
}

template <class Language, class Product>
bool Evaluation<Language, Product>::holds(const ast::Expr& condition, const ScopePtr& scope) {
  return self().is_chosen(eval(condition, scope), condition.span);
}

// Returns the expression to evaluate, or null if the condition varies in space; then `chosen` is set to a value that
// selects at each point.
template <class Language, class Product>
const ast::Expr* Evaluation<Language, Product>::choose(const ast::Conditional& conditional, const ScopePtr& scope,
                                                       Value& chosen) {
  for (size_t n = 0; n < conditional.branches.size(); ++n) {
    const auto& [condition, value] = conditional.branches[n];
    const Value decision = eval(*condition, scope);
    if (decision.object()) {
      const Value yes = eval(*value, scope);
      chosen = choice(decision, yes, otherwise(conditional, n + 1, scope), place(conditional.span, condition->span));
      return nullptr;
    }
    if (is_true(decision)) return value.get();
  }
  return conditional.otherwise.get();
}

// Returns the value of a conditional, starting with branch `first`.
template <class Language, class Product>
Value Evaluation<Language, Product>::otherwise(const ast::Conditional& conditional, size_t first,
                                               const ScopePtr& scope) {
  if (first == conditional.branches.size()) return eval(*conditional.otherwise, scope);
  const auto& [condition, value] = conditional.branches[first];
  const auto level = deeper(condition->span, Language::rules.call_levels);
  const Value decision = eval(*condition, scope);
  if (!decision.object()) return is_true(decision) ? eval(*value, scope) : otherwise(conditional, first + 1, scope);
  const Value yes = eval(*value, scope);
  return choice(decision, yes, otherwise(conditional, first + 1, scope), place(conditional.span, condition->span));
}

// Returns a value that selects one of two at each point, element by element for lists.
template <class Language, class Product>
Value Evaluation<Language, Product>::choice(const Value& condition, const Value& yes, const Value& no,
                                            const ast::Span& where) {
  const List *a = yes.list(), *b = no.list();
  if (a && b && a->items.size() == b->items.size()) {
    ListBuilder result(meter_);
    for (size_t i = 0; i < a->items.size(); ++i) result.push(choice(condition, a->items[i], b->items[i], where));
    return result.finish();
  }
  const Value operands[] = {condition, yes, no};
  const auto made = condition.object()->apply("?:", operands, meter_);
  if (!made) self().stop_at_choice(where, yes, no);
  return *made;
}

}  // namespace ombre::lang

// Expressions of .vcad scripts, in which mistakes are errors.
#include "lang/engine/evaluation_expressions.h"

#include <cmath>

#include "lang/engine/evaluation_calls.h"
#include "lang/engine/evaluation_statements.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

template class Evaluation<Interpreter, Product>;

double Interpreter::passes(const Range& range, const ast::Span& where) {
  const double count = range.count();
  check_count(count, where, "range");
  return count;
}

bool Interpreter::is_one_pass(const Value& values, const ast::Span& where, const char* expected) {
  fail_found(where, expected, values, "a range is written [first : last] or [first : step : last]");
}

void Interpreter::check_pass(uint64_t count, const ast::GenerateLoop& loop) {
  check_count(static_cast<double>(count), loop.condition->span, "loop");
}

void Interpreter::check_count(double count, const ast::Span& where, const char* what) {
  const auto most = static_cast<double>(options_.limits.elements);
  if (count <= most) return;
  const std::string counted = count < 1e18 ? format_count(static_cast<unsigned long long>(count)) : number_text(count);
  fail(where,
       "this " + std::string(what) + " has " + counted + " elements, more than " +
           format_count(options_.limits.elements),
       "choose a larger step or a nearer end");
}

// Returns a constant of the vocabulary, or null.
const Value* Interpreter::find_constant(Symbol name) {
  if (no_constants_.count(name)) return nullptr;
  if (const auto data = vocabulary_.constant(*name)) return &(constants_[name] = from_data(*data, meter_));
  no_constants_.insert(name);
  return nullptr;
}

double Interpreter::number(const ast::Expr& expr, const ScopePtr& scope, const char* what) {
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

Value Interpreter::unary(ast::Operator op, const ast::Span& where, const Value& operand) {
  try {
    return apply(op, operand, meter_);
  } catch (const Mismatch& mismatch) {
    fail_operator(op, where, operand, operand, mismatch);
  }
}

Value Interpreter::binary(ast::Operator op, const ast::Span& where, const Value& left, const Value& right) {
  at_ = where;
  try {
    return apply(op, left, right, meter_);
  } catch (const Mismatch& mismatch) {
    fail_operator(op, where, left, right, mismatch);
  }
}

Value Interpreter::eval_other_member(const ast::Member& member, const Value& base) {
  const std::string& name = member.member.text();
  if (const Record* record = base.record()) {
    if (const Value* value = record->find(name)) return *value;
    std::string names;
    for (const auto& [known, value] : record->members) names += (names.empty() ? "it has ." : ", .") + known;
    fail(member.member.span, "this object has no member ." + name, names);
  }
  if (name != "x" && name != "y" && name != "z") fail(member.member.span, "a vector has the parts .x, .y and .z only");
  fail_found(member.base->span, "only vectors have the parts .x, .y and .z", base);
}

bool Interpreter::is_chosen(const Value& condition, const ast::Span& where) {
  if (condition.object())
    fail(where, "a condition must be known before the job runs, found " + describe(condition),
         "write c ? a : b in an expression, which chooses at each point");
  return is_true(condition);
}

}  // namespace ombre::lang

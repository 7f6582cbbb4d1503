// Expressions of OpenSCAD scripts, in which mistakes give undef.
#include "lang/engine/evaluation_expressions.h"

#include "lang/engine/evaluation_calls.h"
#include "lang/engine/evaluation_statements.h"
#include "lang/openscad/ranges.h"
#include "lang/openscad/script_evaluator.h"

template class ombre::lang::Evaluation<ombre::lang::openscad::Evaluator, ombre::solids::TreePtr>;

namespace ombre::lang::openscad {

namespace {

// True for numbers as they are written, also with signs.
bool is_written(const ast::Expr& expr) {
  if (expr.kind == ast::Expr::Kind::unary) return is_written(*static_cast<const ast::Unary&>(expr).operand);
  return expr.kind == ast::Expr::Kind::number;
}

}  // namespace

void Evaluator::stop_at_depth(const ast::Span& where) { stop("Expressions are nested too deeply", where); }

// Returns 0 and adds a warning if the loop would be too long.
double Evaluator::passes(const Range& range, const ast::Span& where) {
  if (range.step == 0 && range.begin == range.end) return 0;
  const double count = element_count(range);
  if (count < most_range_elements) return count;
  warn("Bad range parameter in for statement: too many elements (" + std::to_string(static_cast<uint64_t>(count)) + ")",
       where, ShownFrom::unit);
  return 0;
}

void Evaluator::check_pass(uint64_t count, const ast::GenerateLoop& loop) {
  if (count >= static_cast<uint64_t>(most_range_elements)) stop("For loop counter exceeded limit", loop.span);
}

Value Evaluator::value_of_unknown(const ast::Name& name, const Scope&) {
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
          "Using ranges of the form [begin:end] with begin value greater than the end value is deprecated", range.span,
          Code::script, ShownFrom::unit);
    }
  } else if (is_written(*range.begin) && is_written(*range.step) && is_written(*range.end)) {
    if (result.step > 0 && result.end < result.begin)
      warn("begin is greater than the end, but step is positive", range.span, ShownFrom::unit);
    else if (result.step < 0 && result.end > result.begin)
      warn("begin is smaller than the end, but step is negative", range.span, ShownFrom::unit);
  }
  return RangePtr(std::make_shared<const Range>(result));
}

Value Evaluator::unary(ast::Operator op, const ast::Span& where, const Value& operand) {
  if (auto made = result_of_objects(ast::spelling(op), {&operand, 1})) return *made;
  Problems problems;
  Value result = openscad::unary(op, operand, meter_, problems);
  warn_all(problems, where, ShownFrom::unit);
  return result;
}

Value Evaluator::operate(ast::Operator op, const ast::Span& where, const Value& left, const Value& right) {
  at_ = where;
  if (left.object() || right.object())
    if (auto made = result_of_objects(ast::spelling(op), std::array{left, right})) return *made;
  Problems problems;
  Value result = openscad::binary(op, left, right, meter_, problems);
  warn_all(problems, where, ShownFrom::unit);
  return result;
}

Value Evaluator::eval_other_member(const ast::Member& member, const Value& base) {
  const std::string& name = member.member.text();
  if (const Record* record = base.record()) {
    const Value* found = record->find(name);
    return found ? *found : Value();
  }
  const Range* range = base.range();
  if (range && name == "begin") return range->begin;
  if (range && name == "step") return range->step;
  if (range && name == "end") return range->end;
  return {};
}

void Evaluator::stop_without_part(const ast::Member& member, const Object&, const std::string& known) {
  stop("there is no ." + member.member.text() + "; " + known, member.span);
}

void Evaluator::stop_at_choice(const ast::Span& where, const Value&, const Value&) {
  stop("this condition varies in space, and chooses between numbers or materials only", where);
}

}  // namespace ombre::lang::openscad

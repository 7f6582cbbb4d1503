#include "lang/engine/operators.h"

#include <cmath>

#include "base/math/math.h"

namespace ombre::lang {
namespace {

using ast::Operator;

[[noreturn]] void mismatch(const Value& a, const Value& b) { throw Mismatch{describe(a), describe(b)}; }

// Computes dot products and products with matrices. For a vector `a`, rows of `b` are summed with weights `a`.
Value product(const Value& left, const Value& right, Meter& meter) {
  const List &a = *left.list(), &b = *right.list();
  if (a.items.empty() || b.items.empty()) mismatch(left, right);
  if (a.items.front().list())
    return of_each(a, meter, [&](const Value& item) { return apply(Operator::multiply, item, right, meter); });
  if (a.items.size() != b.items.size()) mismatch(left, right);
  Value sum = apply(Operator::multiply, a.items.front(), b.items.front(), meter);
  for (size_t i = 1; i < a.items.size(); ++i)
    sum = apply(Operator::add, sum, apply(Operator::multiply, a.items[i], b.items[i], meter), meter);
  return sum;
}

bool is_scalar(const Value& value) { return value.number() || value.object(); }

Value of_objects(Operator op, const Value& left, const Value& right, Meter& meter) {
  const Value operands[] = {left, right};
  const auto made = first_object(operands)->apply(spelling(op), operands, meter);
  if (!made) mismatch(left, right);
  return *made;
}

Value arithmetic(Operator op, const Value& left, const Value& right, Meter& meter) {
  if (left.number() && right.number()) return number_of(op, *left.number(), *right.number());
  const bool a = is_scalar(left), b = is_scalar(right);
  if (a && b) return of_objects(op, left, right, meter);
  const List *list = left.list(), *other = right.list();
  const bool is_sum = op == Operator::add || op == Operator::subtract;
  const auto each = [&](const Value& x, const Value& y) { return apply(op, x, y, meter); };
  if (is_sum && list && other) return of_pairs(*list, *other, meter, each);
  if (op == Operator::multiply && list && other) return product(left, right, meter);
  const bool scales = op == Operator::multiply || op == Operator::divide;
  if (scales && list && b) return of_each(*list, meter, [&](const Value& item) { return each(item, right); });
  if (scales && a && other) return of_each(*other, meter, [&](const Value& item) { return each(left, item); });
  mismatch(left, right);
}

}  // namespace

double number_of(Operator op, double a, double b) {
  switch (op) {
    case Operator::add:
      return a + b;
    case Operator::subtract:
      return a - b;
    case Operator::multiply:
      return a * b;
    case Operator::divide:
      return a / b;
    case Operator::modulo:
      return std::fmod(a, b);
    default:
      return math::pow(a, b);
  }
}

std::optional<bool> ordered_values(Operator op, const Value& left, const Value& right) {
  if (left.number() && right.number()) return ordered(op, *left.number(), *right.number());
  if (left.text() && right.text()) return ordered(op, left.text()->text, right.text()->text);
  if (left.boolean() && right.boolean()) return ordered<int>(op, *left.boolean(), *right.boolean());
  return std::nullopt;
}

Value apply(Operator op, const Value& left, const Value& right, Meter& meter) {
  meter.spend();
  const bool compares = op != Operator::equal && op != Operator::not_equal;
  if ((left.object() || right.object()) &&
      (compares ? !left.list() && !right.list() : is_scalar(left) && is_scalar(right)))
    return of_objects(op, left, right, meter);
  if (op == Operator::equal) return equal(left, right, meter);
  if (op == Operator::not_equal) return !equal(left, right, meter);
  if (!is_order(op)) return arithmetic(op, left, right, meter);
  const auto is_ordered = ordered_values(op, left, right);
  if (!is_ordered) mismatch(left, right);
  return *is_ordered;
}

Value apply(Operator op, const Value& operand, Meter& meter) {
  meter.spend();
  if (const Object* object = operand.object()) {
    const auto made = object->apply(spelling(op), {&operand, 1}, meter);
    if (!made) throw Mismatch{describe(operand), ""};
    return *made;
  }
  if (op == Operator::logical_not) return !is_true(operand);
  if (const double* n = operand.number()) return op == Operator::negate ? -*n : *n;
  const List* list = operand.list();
  if (!list) throw Mismatch{describe(operand), ""};
  return of_each(*list, meter, [&](const Value& item) { return apply(op, item, meter); });
}

}  // namespace ombre::lang

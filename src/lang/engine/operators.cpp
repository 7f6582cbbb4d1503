#include "lang/engine/operators.h"

#include <cmath>
#include "base/math/math.h"

namespace ombre::lang {
namespace {

using ast::Operator;

[[noreturn]] void mismatch(const Value& a, const Value& b) { throw Mismatch{describe(a), describe(b)}; }

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

// Applies the operator element by element, up to the end of the shorter list.
Value zip(Operator op, const List& a, const List& b, Meter& meter) {
  ListBuilder result(meter);
  const size_t size = std::min(a.items.size(), b.items.size());
  result.reserve(size);
  for (size_t i = 0; i < size; ++i) result.push(apply(op, a.items[i], b.items[i], meter));
  return result.finish();
}

Value with_each(Operator op, const List& list, const Value& right, Meter& meter) {
  ListBuilder result(meter);
  result.reserve(list.items.size());
  for (const Value& item : list.items) result.push(apply(op, item, right, meter));
  return result.finish();
}

Value with_each(Operator op, const Value& left, const List& list, Meter& meter) {
  ListBuilder result(meter);
  result.reserve(list.items.size());
  for (const Value& item : list.items) result.push(apply(op, left, item, meter));
  return result.finish();
}

// Computes dot products and products with matrices. For a vector `a`, rows of `b` are summed with weights `a`.
Value product(const Value& left, const Value& right, Meter& meter) {
  const List &a = *left.list(), &b = *right.list();
  if (a.items.empty() || b.items.empty()) mismatch(left, right);
  if (a.items.front().list()) return with_each(Operator::multiply, a, right, meter);
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
  if (is_sum && list && other) return zip(op, *list, *other, meter);
  if (op == Operator::multiply && list && other) return product(left, right, meter);
  const bool scales = op == Operator::multiply || op == Operator::divide;
  if (scales && list && b) return with_each(op, *list, right, meter);
  if (scales && a && other) return with_each(op, left, *other, meter);
  mismatch(left, right);
}

template <class T>
bool ordered(Operator op, const T& a, const T& b) {
  switch (op) {
    case Operator::less:
      return a < b;
    case Operator::less_equal:
      return a <= b;
    case Operator::greater:
      return a > b;
    default:
      return a >= b;
  }
}

bool compare(Operator op, const Value& left, const Value& right) {
  if (left.number() && right.number()) return ordered(op, *left.number(), *right.number());
  if (left.text() && right.text()) return ordered(op, left.text()->text, right.text()->text);
  if (left.boolean() && right.boolean()) return ordered<int>(op, *left.boolean(), *right.boolean());
  mismatch(left, right);
}

}  // namespace

Value apply(Operator op, const Value& left, const Value& right, Meter& meter) {
  meter.spend();
  const bool compares = op != Operator::equal && op != Operator::not_equal;
  if ((left.object() || right.object()) &&
      (compares ? !left.list() && !right.list() : is_scalar(left) && is_scalar(right)))
    return of_objects(op, left, right, meter);
  switch (op) {
    case Operator::equal:
      return equal(left, right, meter);
    case Operator::not_equal:
      return !equal(left, right, meter);
    case Operator::less:
    case Operator::less_equal:
    case Operator::greater:
    case Operator::greater_equal:
      return compare(op, left, right);
    default:
      return arithmetic(op, left, right, meter);
  }
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
  ListBuilder result(meter);
  for (const Value& item : list->items) result.push(apply(op, item, meter));
  return result.finish();
}

}  // namespace ombre::lang

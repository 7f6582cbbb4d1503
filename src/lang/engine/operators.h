// Operators on values.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "lang/engine/value.h"

namespace ombre::lang {

// Descriptions of two values that an operator does not accept. For nested lists these are the innermost values.
struct Mismatch {
  std::string left, right;  // `right` is empty for a unary operator
};

// Applies any operator except "&&" and "||", which do not evaluate both sides. Throws Mismatch.
Value apply(ast::Operator op, const Value& left, const Value& right, Meter& meter);
Value apply(ast::Operator op, const Value& operand, Meter& meter);

// Applies an arithmetic operator.
double number_of(ast::Operator op, double a, double b);

inline bool is_order(ast::Operator op) { return op >= ast::Operator::less && op <= ast::Operator::greater_equal; }

// Applies an operator for which is_order() is true.
template <class T>
bool ordered(ast::Operator op, const T& a, const T& b) {
  if (op == ast::Operator::less) return a < b;
  if (op == ast::Operator::less_equal) return a <= b;
  if (op == ast::Operator::greater) return a > b;
  return a >= b;
}

// Orders two numbers, texts or truth values. Returns nothing for others.
std::optional<bool> ordered_values(ast::Operator op, const Value& left, const Value& right);

// Returns the list of f(item).
template <class F>
Value of_each(const List& list, Meter& meter, const F& f) {
  ListBuilder result(meter);
  result.reserve(list.items.size());
  for (const Value& item : list.items) result.push(f(item));
  return result.finish();
}

// Returns the list of f(item of a, item of b), up to the end of the shorter list.
template <class F>
Value of_pairs(const List& a, const List& b, Meter& meter, const F& f) {
  ListBuilder result(meter);
  const size_t size = std::min(a.items.size(), b.items.size());
  result.reserve(size);
  for (size_t i = 0; i < size; ++i) result.push(f(a.items[i], b.items[i]));
  return result.finish();
}

}  // namespace ombre::lang

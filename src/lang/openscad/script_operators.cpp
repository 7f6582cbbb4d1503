#include "lang/openscad/script_operators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "lang/engine/operators.h"
#include "lang/openscad/ranges.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {
namespace {

using ast::Operator;

class Computation {
 public:
  Computation(Meter& meter, Problems& problems) : meter_(meter), problems_(problems) {}

  Value binary(Operator op, const Value& left, const Value& right) {
    meter_.spend();
    if (op == Operator::equal) return are_equal(left, right);
    if (op == Operator::not_equal) return !are_equal(left, right);
    if (is_order(op)) return comparison(op, left, right);
    return op == Operator::multiply ? product(left, right) : arithmetic(op, left, right);
  }

  Value unary(Operator op, const Value& operand) {
    meter_.spend();
    if (op == Operator::logical_not) return !is_true(operand);
    if (op == Operator::plus) return operand;
    if (const double* n = operand.number()) return op == Operator::negate ? -*n : static_cast<double>(~to_integer(*n));
    if (const List* list = operand.list(); list && op == Operator::negate)
      return of_each(*list, [&](const Value& item) { return unary(op, item); });
    problems_.push_back({std::string("undefined operation (") + ast::spelling(op) + type_name(operand) + ')'});
    return {};
  }

 private:
  Value undefined(Operator op, const Value& left, const Value& right) {
    return fail(std::string("undefined operation (") + type_name(left) + ' ' + ast::spelling(op) + ' ' +
                type_name(right) + ')');
  }
  Value fail(std::string text) {
    problems_.push_back({std::move(text)});
    return {};
  }

  // Removes the warnings of an element, whose undefined result becomes undef.
  Value quietly(Value result, size_t reported) {
    problems_.resize(reported);
    return result;
  }

  template <class F>
  Value of_each(const List& list, const F& f) {
    const size_t reported = problems_.size();
    return lang::of_each(list, meter_, [&](const Value& item) { return quietly(f(item), reported); });
  }

  static int64_t to_integer(double n) {
    constexpr double most = 0x1p63;
    return n >= most ? INT64_MAX : n < -most ? INT64_MIN : std::isnan(n) ? 0 : static_cast<int64_t>(n);
  }

  static Value bits(Operator op, double left, double right) {
    const int64_t a = to_integer(left), b = to_integer(right);
    if (op == Operator::bit_or) return static_cast<double>(a | b);
    if (op == Operator::bit_and) return static_cast<double>(a & b);
    constexpr int64_t width = 64;
    if (b < 0 || b >= width) return b < 0 ? Value() : Value(op == Operator::shift_right && a < 0 ? -1.0 : 0.0);
    if (op == Operator::shift_right) return static_cast<double>(a >> b);
    return static_cast<double>(static_cast<int64_t>(static_cast<uint64_t>(a) << b));
  }

  static Value of_numbers(Operator op, double a, double b) {
    const bool has_bits =
        op == Operator::bit_or || op == Operator::bit_and || op == Operator::shift_left || op == Operator::shift_right;
    return has_bits ? bits(op, a, b) : Value(number_of(op, a, b));
  }

  Value arithmetic(Operator op, const Value& left, const Value& right) {
    if (left.number() && right.number()) return of_numbers(op, *left.number(), *right.number());
    const List *a = left.list(), *b = right.list();
    if ((op == Operator::add || op == Operator::subtract) && a && b) return zip(op, *a, *b);
    if (op == Operator::divide && a && right.number())
      return of_each(*a, [&](const Value& item) { return binary(op, item, right); });
    if (op == Operator::divide && left.number() && b)
      return of_each(*b, [&](const Value& item) { return binary(op, left, item); });
    return undefined(op, left, right);
  }

  Value zip(Operator op, const List& a, const List& b) {
    const size_t reported = problems_.size();
    return of_pairs(a, b, meter_, [&](const Value& x, const Value& y) { return quietly(binary(op, x, y), reported); });
  }

  Value product(const Value& left, const Value& right) {
    if (left.number() && right.number()) return *left.number() * *right.number();
    const List *a = left.list(), *b = right.list();
    if (left.number() && b) return of_each(*b, [&](const Value& item) { return product(left, item); });
    if (a && right.number()) return of_each(*a, [&](const Value& item) { return product(item, right); });
    if (!a || !b) return undefined(Operator::multiply, left, right);
    return of_lists(*a, *b);
  }

  Value of_lists(const List& a, const List& b) {
    if (a.items.empty() || b.items.empty()) return fail("Multiplication is undefined on empty vectors");
    const Value &first = a.items.front(), &other = b.items.front();
    if (first.number() && other.number()) return vector_by_vector(a, b);
    if (first.list() && other.number())
      return rows_by(&Computation::vector_by_vector, a, b,
                     "matrix*vector requires matrix column count to match vector length");
    if (first.number() && other.list()) return vector_by_matrix(a, b);
    if (first.list() && other.list())
      return rows_by(&Computation::vector_by_matrix, a, b,
                     "matrix*matrix requires left operand column count to match right operand row count");
    return fail(std::string("undefined vector*vector multiplication where first elements are types ") +
                type_name(first) + " and " + type_name(other));
  }

  Value not_rectangular(size_t row) {
    return fail("Matrix must be rectangular. Problem at row " + std::to_string(row));
  }
  // The message for a row of a matrix that cannot be multiplied with a vector, or with a matrix.
  Value wrong_row(size_t row, size_t size, const List& by) {
    if (by.items.front().number()) return not_rectangular(row);
    return fail("matrix*matrix left operand row length does not match right operand row count" +
                sizes(size, by.items.size()) + " at row " + std::to_string(row));
  }
  static std::string sizes(size_t a, size_t b) { return " (" + std::to_string(a) + " != " + std::to_string(b) + ")"; }

  Value vector_by_vector(const List& a, const List& b) {
    if (a.items.size() != b.items.size())
      return fail("vector*vector requires matching lengths" + sizes(a.items.size(), b.items.size()));
    double sum = 0;
    for (size_t i = 0; i < a.items.size(); ++i) {
      meter_.spend();
      const double *x = a.items[i].number(), *y = b.items[i].number();
      if (!x || !y) return undefined(Operator::multiply, a.items[i], b.items[i]);
      sum += *x * *y;
    }
    return sum;
  }

  // Multiplies each row of a matrix with a vector or matrix, from the left.
  Value rows_by(Value (Computation::*times)(const List&, const List&), const List& a, const List& b,
                const char* requirement) {
    const size_t columns = a.items.front().list()->items.size();
    if (columns != b.items.size()) return fail(requirement + sizes(columns, b.items.size()));
    ListBuilder result(meter_);
    for (size_t row = 0; row < a.items.size(); ++row) {
      const List* line = a.items[row].list();
      if (!line || line->items.size() != columns) return wrong_row(row, line ? line->items.size() : 0, b);
      Value product = (this->*times)(*line, b);
      if (product.is_undef()) return {};
      result.push(std::move(product));
    }
    return result.finish();
  }

  Value vector_by_matrix(const List& a, const List& b) {
    if (a.items.size() != b.items.size())
      return fail("vector*matrix requires vector length to match matrix row count" +
                  sizes(a.items.size(), b.items.size()));
    const size_t columns = b.items.front().list()->items.size();
    ListBuilder result(meter_);
    for (size_t column = 0; column < columns; ++column) {
      double sum = 0;
      for (size_t row = 0; row < b.items.size(); ++row) {
        meter_.spend();
        const List* line = b.items[row].list();
        if (!line || line->items.size() != columns) {
          problems_.push_back({"Matrix must be rectangular. Problem at row " + std::to_string(row), false});
          return not_rectangular(row);
        }
        const double *x = a.items[row].number(), *y = line->items[column].number();
        if (!x || !y) return undefined(Operator::multiply, a.items[row], line->items[column]);
        sum += *x * *y;
      }
      result.push(sum);
    }
    return result.finish();
  }

  bool are_equal(const Value& left, const Value& right) {
    const Range *a = left.range(), *b = right.range();
    return a && b ? order_key(*a) == order_key(*b) : equal(left, right, meter_);
  }

  Value comparison(Operator op, const Value& left, const Value& right) {
    if (const auto is_ordered = ordered_values(op, left, right)) return *is_ordered;
    if (left.list() && right.list()) return of_vectors(op, *left.list(), *right.list());
    if (const Range* a = left.range(), *b = right.range(); a && b) return ordered(op, order_key(*a), order_key(*b));
    const std::string type = type_name(left);
    if ((left.is_undef() && right.is_undef()) || (left.closure() && right.closure()))
      return fail("operation undefined (" + type + ' ' + ast::spelling(op) + ' ' + type + ')');
    return undefined(op, left, right);
  }

  // Compares vectors lexicographically: by the first elements that differ, else by length.
  Value of_vectors(Operator op, const List& a, const List& b) {
    const size_t size = std::min(a.items.size(), b.items.size());
    for (size_t i = 0; i < size; ++i) {
      for (const bool is_swapped : {false, true}) {
        const Value &x = is_swapped ? b.items[i] : a.items[i], &y = is_swapped ? a.items[i] : b.items[i];
        const Value is_less = binary(Operator::less, x, y);
        if (is_less.is_undef()) {
          problems_.back().text += "\n\tin vector comparison at index " + std::to_string(i);
          return {};
        }
        if (!is_true(is_less)) continue;
        const bool is_first = !is_swapped, is_less_wanted = op == Operator::less || op == Operator::less_equal;
        return is_first == is_less_wanted;
      }
    }
    return ordered(op, a.items.size(), b.items.size());
  }

  Meter& meter_;
  Problems& problems_;
};

}  // namespace

Value binary(Operator op, const Value& left, const Value& right, Meter& meter, Problems& problems) {
  return Computation(meter, problems).binary(op, left, right);
}

Value unary(Operator op, const Value& operand, Meter& meter, Problems& problems) {
  return Computation(meter, problems).unary(op, operand);
}

}  // namespace ombre::lang::openscad

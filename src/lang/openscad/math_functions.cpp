// Functions of numbers.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/vec.h"
#include "lang/openscad/script_functions.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {
namespace {

using Call = FunctionCall;

// OpenSCAD's sine is -0 at odd multiples of 180 degrees, so that atan2() finds -180 degrees again.
double sine(double angle) {
  const double y = degrees::sine(angle);
  return y == 0 && std::isfinite(angle) && std::fmod(angle, 360) != 0 ? -0.0 : y;
}

double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// Returns the extreme of the elements of one vector, of any type, or of several numbers.
template <bool is_greatest>
Value extreme(const Call& call) {
  if (const List* list = call[0].list(); list && call.size() == 1) {
    if (list->items.empty()) return call.wrong_type();
    Value best = list->items.front();
    Problems ignored;
    for (const Value& item : list->items) {
      const Value is_less = is_greatest ? binary(ast::Operator::less, best, item, call.meter, ignored)
                                        : binary(ast::Operator::less, item, best, call.meter, ignored);
      if (is_true(is_less)) best = item;
    }
    return best;
  }
  double best = 0;
  for (size_t i = 0; i < call.size(); ++i) {
    const double* x = call[i].number();
    if (!x) return call.wrong_type();
    if (i == 0 || (is_greatest ? *x > best : *x < best)) best = *x;
  }
  return best;
}

Value norm(const Call& call) {
  const List* list = call[0].list();
  if (!list) return {};
  double sum = 0;
  for (const Value& item : list->items) {
    if (!item.number()) return call.fail("Incorrect arguments to norm()");
    sum += *item.number() * *item.number();
  }
  return std::sqrt(sum);
}

Value cross_of_three(const Call& call) {
  Vec3 a, b;
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<size_t>(axis);
    const double *x = call[0].list()->items[n].number(), *y = call[1].list()->items[n].number();
    if (!x || !y) return call.fail("Invalid value in parameter vector for cross()");
    if (std::isnan(*x) || std::isnan(*y)) return call.fail("Invalid value (NaN) in parameter vector for cross()");
    if (std::isinf(*x) || std::isinf(*y)) return call.fail("Invalid value (INF) in parameter vector for cross()");
    a[axis] = *x, b[axis] = *y;
  }
  const Vec3 normal = ombre::cross(a, b);
  return make_list({normal.x, normal.y, normal.z}, call.meter);
}

Value cross(const Call& call) {
  if (call.size() != 2) return call.fail("Invalid number of parameters for cross()");
  const List *a = call[0].list(), *b = call[1].list();
  if (!a || !b) return call.fail("Invalid type of parameters for cross()");
  const auto number = [](const List& list, size_t i) { return list.items[i].number() ? *list.items[i].number() : 0; };
  if (a->items.size() == 2 && b->items.size() == 2)
    return number(*a, 0) * number(*b, 1) - number(*a, 1) * number(*b, 0);
  if (a->items.size() != 3 || b->items.size() != 3) return call.fail("Invalid vector size of parameter for cross()");
  return cross_of_three(call);
}

// Returns a number in [0, 1), made of two 32-bit numbers of the generator as C++'s std::generate_canonical does.
double draw(std::mt19937& random) {
  const auto low = static_cast<double>(random()), high = static_cast<double>(random());
  return std::min((low + high * 0x1p32) * 0x1p-64, std::nextafter(1.0, 0.0));
}

double finite_bound(const Call& call, double bound, const char* which, double otherwise) {
  if (std::isfinite(bound)) return bound;
  call.fail(std::string("rands() range ") + which + " cannot be infinite");
  call.note("resetting to " + std::to_string(otherwise));
  return otherwise;
}

// Returns the remainder of a number modulo the prime 2^31 - 1, by Python's rules for hashes of numbers. A fraction m /
// n is m times the inverse of n. Powers of two repeat, since 2^31 is 1 modulo this prime.
int64_t remainder_of(double value) {
  constexpr int64_t prime = 0x7fffffff, infinite = 314159;
  constexpr int period = 31, digits = std::numeric_limits<double>::digits;
  if (std::isnan(value)) return 0;
  if (std::isinf(value)) return value > 0 ? infinite : -infinite;
  int exponent = 0;
  const auto mantissa = static_cast<int64_t>(std::ldexp(std::frexp(std::abs(value), &exponent), digits));
  const int shift = ((exponent - digits) % period + period) % period;
  const int64_t remainder = ((mantissa % prime) << shift) % prime;
  return value < 0 ? -remainder : remainder;
}

double wanted_count(const Call& call, double wanted) {
  if (std::isfinite(wanted)) return std::trunc(std::abs(wanted));
  call.fail("rands() cannot create an infinite number of results");
  call.note("resetting number of results to 1");
  return 1;
}

Value rands(const Call& call) {
  const double *from = call[0].number(), *to = call[1].number(), *wanted = call[2].number();
  if (!from || !to || !wanted || (call.size() == 4 && !call[3].number())) return {};
  constexpr double most = std::numeric_limits<double>::max() / 2;
  double low = finite_bound(call, *from, "min", -most), high = finite_bound(call, *to, "max", most);
  if (low > high) std::swap(low, high);
  const double count = wanted_count(call, *wanted);
  if (count > static_cast<double>(call.meter.limits().elements)) call.meter.too_many_elements();
  if (call.size() == 4) call.random.seed(static_cast<uint32_t>(remainder_of(*call[3].number())));
  ListBuilder result(call.meter);
  call.meter.spend(static_cast<uint64_t>(count));
  for (double i = 0; i < count; ++i) result.push(low == high ? low : low + (high - low) * draw(call.random));
  return result.finish();
}

}  // namespace

std::vector<NamedFunction> math_functions() {
  return {{"sin", common::of_number<sine>, 1, 1},
          {"sign", common::of_number<sign_of>, 1, 1},
          {"log", common::logarithm, 1, 2},
          {"min", extreme<false>, 1, any_number, true},
          {"max", extreme<true>, 1, any_number, true},
          {"norm", norm, 1, 1},
          {"cross", cross},
          {"rands", rands, 3, 4, true}};
}

}  // namespace ombre::lang::openscad

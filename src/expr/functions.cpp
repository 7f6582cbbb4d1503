#include "expr/functions.h"

#include <numbers>

namespace ombre::expr {
namespace {

using program::Field;
using program::Op;
using Arguments = std::span<const Field>;

constexpr double pi = std::numbers::pi;

template <Op op>
Field unary(Arguments a) {
  return a[0].builder->apply(op, a[0]);
}

template <Op op>
Field binary(Arguments a) {
  return a[0].builder->apply(op, a[0], a[1]);
}

Field sum(Arguments a) {
  return program::fold({a.begin(), a.end()}, [](Field p, Field q) { return p + q; });
}

Field sign(Arguments a) {
  const Field v = a[0], zero = v.builder->constant(0);
  return program::less(zero, v) - program::less(v, zero);
}

// Returns the density of the normal distribution.
Field normal_dist(Arguments a) {
  program::Builder& builder = *a[0].builder;
  const Field mean = a.size() > 1 ? a[1] : builder.constant(0), deviation = a.size() > 2 ? a[2] : builder.constant(1);
  const Field t = (a[0] - mean) / deviation;
  const Field bell = builder.apply(Op::exp, -0.5 * square(t));
  return bell / (deviation * std::sqrt(2 * pi));
}

constexpr auto table = std::to_array<Function>({
    {"sin", 1, 1, "v", "sine, v in radians", unary<Op::sin>},
    {"cos", 1, 1, "v", "cosine, v in radians", unary<Op::cos>},
    {"tan", 1, 1, "v", "tangent, v in radians", unary<Op::tan>},
    {"asin", 1, 1, "v", "arc sine in radians", unary<Op::asin>},
    {"acos", 1, 1, "v", "arc cosine in radians", unary<Op::acos>},
    {"atan", 1, 1, "v", "arc tangent in radians", unary<Op::atan>},
    {"atan2", 2, 2, "y, x", "angle of the vector (x, y), in (-pi, pi]", binary<Op::atan2>},
    {"sinh", 1, 1, "v", "hyperbolic sine", unary<Op::sinh>},
    {"cosh", 1, 1, "v", "hyperbolic cosine", unary<Op::cosh>},
    {"tanh", 1, 1, "v", "hyperbolic tangent", unary<Op::tanh>},
    {"exp", 1, 1, "v", "e to the power v", unary<Op::exp>},
    {"log", 1, 1, "v", "natural logarithm", unary<Op::log>},
    {"log10", 1, 1, "v", "logarithm to base 10", unary<Op::log10>},
    {"log2", 1, 1, "v", "logarithm to base 2", unary<Op::log2>},
    {"sqrt", 1, 1, "v", "square root", unary<Op::sqrt>},
    {"pow", 2, 2, "b, e", "b to the power e, as b^e", [](Arguments a) { return program::power(a[0], a[1]); }},
    {"hypot", 2, 2, "a, b", "sqrt(a^2 + b^2)", [](Arguments a) { return program::length(a[0], a[1]); }},
    {"abs", 1, 1, "v", "absolute value", unary<Op::abs>},
    {"sgn", 1, 1, "v", "-1, 0 or 1", sign},
    {"floor", 1, 1, "v", "greatest integer not above v", unary<Op::floor>},
    {"ceil", 1, 1, "v", "least integer not below v", unary<Op::ceil>},
    {"round", 1, 1, "v", "nearest integer, halves away from zero", unary<Op::round>},
    {"trunc", 1, 1, "v", "v without its fraction", unary<Op::trunc>},
    {"frac", 1, 1, "v", "v - trunc(v)", [](Arguments a) { return a[0] - a[0].builder->apply(Op::trunc, a[0]); }},
    {"mod", 2, 2, "a, b", "remainder of a/b with the sign of a, as a % b", binary<Op::mod>},
    {"min", 1, -1, "a, b, ...", "least", [](Arguments a) { return program::fold({a.begin(), a.end()}, program::min); }},
    {"max", 1, -1, "a, b, ...", "greatest",
     [](Arguments
            a) { return program::fold({a.begin(), a.end()}, static_cast<Field (*)(Field, Field)>(program::max)); }},
    {"avg", 1, -1, "a, b, ...", "mean", [](Arguments a) { return sum(a) / static_cast<double>(a.size()); }},
    {"sum", 1, -1, "a, b, ...", "sum", sum},
    {"mand", 1, -1, "a, b, ...", "1 if none is 0, else 0",
     [](Arguments a) { return program::truth(program::fold({a.begin(), a.end()}, program::logical_and)); }},
    {"mor", 1, -1, "a, b, ...", "0 if all are 0, else 1",
     [](Arguments a) { return program::truth(program::fold({a.begin(), a.end()}, program::logical_or)); }},
    {"clamp", 3, 3, "lo, v, hi", "v, but at least lo and at most hi",
     [](Arguments a) { return program::min(program::max(a[1], a[0]), a[2]); }},
    {"deg2rad", 1, 1, "v", "degrees to radians", [](Arguments a) { return a[0] * (pi / 180); }},
    {"rad2deg", 1, 1, "v", "radians to degrees", [](Arguments a) { return a[0] * (180 / pi); }},
    {"normal_dist", 1, 3, "v, mean = 0, sd = 1", "density of the normal distribution", normal_dist},
    {"if", 3, 3, "c, a, b", "a where c is not 0, else b",
     [](Arguments a) { return program::select(a[0], a[1], a[2]); }},
});

}  // namespace

std::span<const Function> functions() { return table; }

const Function* find_function(std::string_view name) {
  for (const Function& function : table)
    if (function.name == name) return &function;
  return nullptr;
}

}  // namespace ombre::expr

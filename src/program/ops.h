// The meaning of each op, written once for every type of value (double, interval, ...).
//
// The results on doubles are the reference for all other evaluators.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/math/math.h"

// A row for each op: its name and number of operands. math::name is its meaning.
// clang-format off
#define OMBRE_OPS(row)                                                                     \
  row(add, 2) row(subtract, 2) row(multiply, 2) row(divide, 2) row(negate, 1)              \
  row(min, 2) row(max, 2) row(abs, 1) row(sqrt, 1) row(square, 1) row(mod, 2) row(pow, 2)  \
  row(floor, 1) row(ceil, 1) row(round, 1) row(trunc, 1)                                   \
  row(sin, 1) row(cos, 1) row(tan, 1) row(asin, 1) row(acos, 1) row(atan, 1) row(atan2, 2) \
  row(sinh, 1) row(cosh, 1) row(tanh, 1) row(exp, 1) row(log, 1) row(log10, 1) row(log2, 1) \
  row(less, 2) row(less_equal, 2) row(equal, 2) row(truth, 1)                              \
  row(logical_not, 1) row(logical_and, 2) row(logical_or, 2) row(select, 3) row(is_finite, 1) \
  row(fma, 3) row(share, 2)
// clang-format on

namespace ombre::program {

enum class Op : uint8_t {
  input,     // value: the number of the program's input (0, 1, 2: x, y, z)
  constant,  // value: the constant
  affine,    // ((m[0]*a + m[1]*b) + m[2]*c) + m[3], with m = program.maps[aux]
  source,    // channel of a field source at (a, b, c), given by program.reads[aux]
  call,      // output of a body at (a, b, c), given by program.calls[aux]
  parts,     // slot `value` of many parts at (a, b, c), given by program.part_sets[aux]
#define OMBRE_ROW(name, arity) name,
  OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
};

// All ops that compute with numbers.
inline constexpr Op numeric_ops[] = {
#define OMBRE_ROW(name, arity) Op::name,
    OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
};

struct OpInfo {
  std::string_view name;
  int arity;
};

inline constexpr auto op_table = std::to_array<OpInfo>({{"input", 0},
                                                        {"constant", 0},
                                                        {"affine", 3},
                                                        {"source", 3},
                                                        {"call", 3},
                                                        {"parts", 3},
#define OMBRE_ROW(name, arity) {#name, arity},
                                                        OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
});

inline const OpInfo& info(Op op) { return op_table[static_cast<size_t>(op)]; }

// True if the result is always 1 or 0.
constexpr bool gives_truth(Op op) {
  switch (op) {
    case Op::less:
    case Op::less_equal:
    case Op::equal:
    case Op::truth:
    case Op::logical_not:
    case Op::logical_and:
    case Op::logical_or:
    case Op::is_finite:
      return true;
    default:
      return false;
  }
}

using AffineRow = std::array<double, 4>;

inline double apply_affine(const AffineRow& m, double a, double b, double c) {
  return ((m[0] * a + m[1] * b) + m[2] * c) + m[3];
}

inline Interval apply_affine(const AffineRow& m, Interval a, Interval b, Interval c) {
  using math::add;
  const auto term = [](double factor, Interval v) { return factor == 0 ? Interval(0) : math::multiply(factor, v); };
  return add(add(add(term(m[0], a), term(m[1], b)), term(m[2], c)), m[3]);
}

// Computes an arithmetic op. `T` is double, Interval, or any type with the functions of math.h.
template <class T>
T apply(Op op, const T& a, const T& b, const T& c) {
  switch (op) {
#define OMBRE_CALL_1(name) math::name(a)
#define OMBRE_CALL_2(name) math::name(a, b)
#define OMBRE_CALL_3(name) math::name(a, b, c)
#define OMBRE_ROW(name, arity) \
  case Op::name:               \
    return OMBRE_CALL_##arity(name);
    OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
#undef OMBRE_CALL_1
#undef OMBRE_CALL_2
#undef OMBRE_CALL_3
    default:
      return a;  // inputs, constants, sources and calls are not arithmetic
  }
}

}  // namespace ombre::program

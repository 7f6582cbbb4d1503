// Ops on SIMD vectors. Included once for each instruction set.
//
// Every function gives the same bits on all instruction sets. It uses operations that IEEE 754 rounds correctly,
// explicit fused multiply-adds, and SLEEF's deterministic family ("finz") for the rest.

#if defined(OMBRE_EVAL_BATCH_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OMBRE_EVAL_BATCH_MATH_INL_H_
#undef OMBRE_EVAL_BATCH_MATH_INL_H_
#else
#define OMBRE_EVAL_BATCH_MATH_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "program/single.h"

HWY_BEFORE_NAMESPACE();
namespace ombre::eval {
namespace HWY_NAMESPACE {
namespace batch {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE V number(float v) { return hn::Set(D(), v); }
HWY_INLINE V one_where(M m) { return hn::IfThenElseZero(m, number(1)); }
HWY_INLINE M is_nan(V v) { return hn::IsNaN(v); }
// Does not use Ne, whose result for NaN differs between instruction sets.
HWY_INLINE M is_set(V v) { return hn::Not(hn::Eq(v, hn::Zero(D()))); }
HWY_INLINE V nan_where(M m, V otherwise) {
  return hn::IfThenElse(m, number(std::numeric_limits<float>::quiet_NaN()), otherwise);
}

#if HWY_NATIVE_FMA
HWY_INLINE V fma(V a, V b, V c) { return hn::MulAdd(a, b, c); }
#else
HWY_INLINE V fma(V a, V b, V c) {
  constexpr size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN float x[lanes], y[lanes], z[lanes];
  hn::Store(a, D(), x);
  hn::Store(b, D(), y);
  hn::Store(c, D(), z);
  for (size_t n = 0; n < hn::Lanes(D()); ++n) x[n] = std::fma(x[n], y[n], z[n]);
  return hn::Load(D(), x);
}
#endif

// SLEEF's functions for each instruction set. They are declared here, since its header declares only those for sets
// that are enabled for the whole file.
#if HWY_TARGET == HWY_AVX2
#define OMBRE_SLEEF_RAW __m256
#define OMBRE_SLEEF_NAME(name, suffix) Sleef_finz_##name##f8_##suffix##avx2
#elif HWY_TARGET == HWY_AVX3
#define OMBRE_SLEEF_RAW __m512
#define OMBRE_SLEEF_NAME(name, suffix) Sleef_finz_##name##f16_##suffix##avx512f
#else
#define OMBRE_SLEEF_RAW float
#define OMBRE_SLEEF_NAME(name, suffix) Sleef_finz_##name##f1_##suffix##purecfma
#endif

// Calls a function on the whole vector, or lane by lane.
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
template <class F>
HWY_INLINE V through(F f, V a) {
  return V{f(a.raw)};
}
template <class F>
HWY_INLINE V through(F f, V a, V b) {
  return V{f(a.raw, b.raw)};
}
#else
template <class F, class... Vs>
HWY_INLINE V through(F f, V first, Vs... others) {
  constexpr size_t lanes = hn::MaxLanes(D());
  HWY_ALIGN float rows[1 + sizeof...(others)][lanes];
  hn::Store(first, D(), rows[0]);
  if constexpr (sizeof...(others) > 0) hn::Store(others..., D(), rows[1]);
  for (size_t n = 0; n < hn::Lanes(D()); ++n) {
    if constexpr (sizeof...(others) > 0)
      rows[0][n] = f(rows[0][n], rows[1][n]);
    else
      rows[0][n] = f(rows[0][n]);
  }
  return hn::Load(D(), rows[0]);
}
#endif

#define OMBRE_SLEEF_1(name, suffix)                                           \
  extern "C" OMBRE_SLEEF_RAW OMBRE_SLEEF_NAME(name, suffix)(OMBRE_SLEEF_RAW); \
  HWY_INLINE V name(V a) { return through(OMBRE_SLEEF_NAME(name, suffix), a); }
#define OMBRE_SLEEF_2(name, sleef_name, suffix)                                                      \
  extern "C" OMBRE_SLEEF_RAW OMBRE_SLEEF_NAME(sleef_name, suffix)(OMBRE_SLEEF_RAW, OMBRE_SLEEF_RAW); \
  HWY_INLINE V name(V a, V b) { return through(OMBRE_SLEEF_NAME(sleef_name, suffix), a, b); }
OMBRE_SLEEF_1(tan, u10)
OMBRE_SLEEF_1(asin, u10)
OMBRE_SLEEF_1(acos, u10)
OMBRE_SLEEF_1(atan, u10)
OMBRE_SLEEF_1(sinh, u10)
OMBRE_SLEEF_1(cosh, u10)
OMBRE_SLEEF_1(tanh, u10)
OMBRE_SLEEF_1(exp, u10)
OMBRE_SLEEF_1(log, u10)
OMBRE_SLEEF_1(log10, u10)
OMBRE_SLEEF_1(log2, u10)
OMBRE_SLEEF_2(atan2, atan2, u10)
OMBRE_SLEEF_2(pow, pow, u10)
OMBRE_SLEEF_2(mod, fmod, )
#undef OMBRE_SLEEF_1
#undef OMBRE_SLEEF_2
#undef OMBRE_SLEEF_RAW
#undef OMBRE_SLEEF_NAME

HWY_INLINE V add(V a, V b) { return hn::Add(a, b); }
HWY_INLINE V subtract(V a, V b) { return hn::Sub(a, b); }
HWY_INLINE V multiply(V a, V b) { return hn::Mul(a, b); }
HWY_INLINE V divide(V a, V b) { return hn::Div(a, b); }
HWY_INLINE V negate(V v) { return hn::Neg(v); }
HWY_INLINE V square(V v) { return hn::Mul(v, v); }
HWY_INLINE V abs(V v) { return hn::Abs(v); }
HWY_INLINE V sqrt(V v) { return hn::Sqrt(v); }
// Zeros keep their sign, which emulated instructions lose.
HWY_INLINE V floor(V v) { return hn::CopySign(hn::Floor(v), v); }
HWY_INLINE V ceil(V v) { return hn::CopySign(hn::Ceil(v), v); }
HWY_INLINE V trunc(V v) { return hn::CopySign(hn::Trunc(v), v); }
// Rounds halves away from zero. The difference from the integer part is exact.
HWY_INLINE V round(V v) {
  const V whole = trunc(v), rest = hn::Sub(v, whole);
  const V away = hn::Add(whole, hn::CopySign(number(1), v));
  return hn::IfThenElse(hn::Ge(hn::Abs(rest), number(0.5f)), away, whole);
}
// Does not use the processor's minimum, which may return either zero or NaN.
HWY_INLINE V min(V a, V b) { return hn::IfThenElse(hn::Lt(b, a), b, a); }
HWY_INLINE V max(V a, V b) { return hn::IfThenElse(hn::Gt(b, a), b, a); }
HWY_INLINE V less(V a, V b) { return one_where(hn::Lt(a, b)); }
HWY_INLINE V less_equal(V a, V b) { return one_where(hn::Le(a, b)); }
HWY_INLINE V equal(V a, V b) { return one_where(hn::Eq(a, b)); }
HWY_INLINE V truth(V v) { return one_where(is_set(v)); }
HWY_INLINE V logical_not(V v) { return one_where(hn::Eq(v, hn::Zero(D()))); }
HWY_INLINE V logical_and(V a, V b) { return one_where(hn::And(is_set(a), is_set(b))); }
HWY_INLINE V logical_or(V a, V b) { return one_where(hn::Or(is_set(a), is_set(b))); }
HWY_INLINE V share(V part, V total) {
  const V quotient = hn::Div(part, total), most = hn::IfThenElse(hn::Gt(quotient, number(1)), number(1), quotient);
  return hn::IfThenElseZero(hn::Gt(total, hn::Zero(D())), most);
}
HWY_INLINE V select(V condition, V a, V b) { return hn::IfThenElse(is_set(condition), a, b); }
// Returns NaN for infinities, since a value that overflowed may be finite in double precision.
HWY_INLINE V is_finite(V v) {
  const M finite = hn::Lt(hn::Abs(v), number(std::numeric_limits<float>::infinity()));
  return nan_where(hn::Not(finite), number(1));
}

// Computes sine and cosine. Subtracts the nearest multiple of pi/2 in three parts (Cody and Waite), then evaluates
// polynomials for [-pi/4, pi/4] with the coefficients of Cephes' single-precision functions.
struct SineCosine {
  V sine, cosine;
};
HWY_INLINE SineCosine sine_cosine(V v) {
  const DU du;
  const V shift = number(0x1.8p23f);  // adding it moves integers to the last bits
  const V shifted = fma(v, number(0x1.45f306p-1f), shift);
  const V quarters = hn::Sub(shifted, shift);
  const hn::Vec<DU> turn = hn::BitCast(du, shifted);
  V r = fma(quarters, number(-0x1.921fb6p0f), v);
  r = fma(quarters, number(0x1.777a5cp-25f), r);
  r = fma(quarters, number(0x1.ee59dap-50f), r);
  const V square_r = hn::Mul(r, r);
  V s = fma(square_r, number(-1.9515295891e-4f), number(8.3321608736e-3f));
  s = fma(square_r, s, number(-1.6666654611e-1f));
  s = fma(hn::Mul(square_r, r), s, r);
  V c = fma(square_r, number(2.443315711809948e-5f), number(-1.388731625493765e-3f));
  c = fma(square_r, c, number(4.166664568298827e-2f));
  c = fma(square_r, c, number(-0.5f));
  c = fma(square_r, c, number(1));
  const M odd = hn::MaskFromVec(hn::BitCast(D(), hn::Sub(hn::Zero(du), hn::And(turn, hn::Set(du, 1u)))));
  const auto sign_if = [&](hn::Vec<DU> bit_1) {
    return hn::BitCast(D(), hn::ShiftLeft<30>(hn::And(bit_1, hn::Set(du, 2u))));
  };
  const V sine = hn::Xor(hn::IfThenElse(odd, c, s), sign_if(turn));
  const V cosine = hn::Xor(hn::IfThenElse(odd, s, c), sign_if(hn::Add(turn, hn::Set(du, 1u))));
  const M outside = hn::Not(hn::Le(hn::Abs(v), number(static_cast<float>(program::batch_trigonometric_limit))));
  return {nan_where(outside, sine), nan_where(outside, cosine)};
}
HWY_INLINE V sin(V v) { return sine_cosine(v).sine; }
HWY_INLINE V cos(V v) { return sine_cosine(v).cosine; }

}  // namespace batch
}  // namespace HWY_NAMESPACE
}  // namespace ombre::eval
HWY_AFTER_NAMESPACE();

#endif

#include "import/charts/prism_rows.h"

#include "base/system/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "import/charts/prism_rows.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ombre::importing::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, PrismRow::most>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE V number(double v) { return hn::Set(D(), v); }

// Vectors of one point in each lane.
struct Vecs {
  V x, y, z;
};
HWY_INLINE Vecs same(Vec3 v) { return {number(v.x), number(v.y), number(v.z)}; }
HWY_INLINE Vecs minus(const Vecs& a, const Vecs& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vecs plus(const Vecs& a, const Vecs& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE Vecs times(V s, const Vecs& a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
HWY_INLINE V dot(const Vecs& a, const Vecs& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Vecs cross(const Vecs& a, const Vecs& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE Vecs moved(Vec3 from, Vec3 by, V t) { return plus(same(from), times(t, same(by))); }
HWY_INLINE V limited(V v, V lo, V hi) {
  return hn::IfThenElse(hn::Lt(v, lo), lo, hn::IfThenElse(hn::Lt(hi, v), hi, v));
}

// The cubic polynomial whose root is the height (Prism::find), at one point in each lane.
struct Cubic {
  V a0, a1, a2, a3;
  HWY_INLINE V at(V t) const { return hn::Add(a0, hn::Mul(t, hn::Add(a1, hn::Mul(t, hn::Add(a2, hn::Mul(t, a3)))))); }
  HWY_INLINE V slope(V t) const {
    const V third = hn::Mul(hn::Mul(number(3), t), a3);
    return hn::Add(a1, hn::Mul(t, hn::Add(hn::Mul(number(2), a2), third)));
  }
};

HWY_INLINE V root_of(const Cubic& cubic, Interval heights) {
  V lo = number(heights.lo), hi = number(heights.hi);
  const V zero = hn::Zero(D()), half = number(0.5), near = number(1e-14 * (heights.hi - heights.lo));
  V t = limited(hn::IfThenElse(hn::Eq(cubic.a1, zero), lo, hn::Div(hn::Neg(cubic.a0), cubic.a1)), lo, hi);
  M is_done = hn::Gt(zero, zero);
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step) {
    const V value = cubic.at(t), slope = cubic.slope(t);
    const M is_above = hn::Gt(value, zero);
    lo = hn::IfThenElse(is_above, t, lo);
    hi = hn::IfThenElse(is_above, hi, t);
    const V middle = hn::Mul(half, hn::Add(lo, hi));
    V next = hn::IfThenElse(hn::Lt(slope, zero), hn::Sub(t, hn::Div(value, slope)), middle);
    next = hn::IfThenElse(hn::And(hn::Ge(next, lo), hn::Le(next, hi)), next, middle);
    const M is_last = hn::Le(hn::Abs(hn::Sub(next, t)), near);
    t = hn::IfThenElse(is_done, t, next);
    is_done = hn::Or(is_done, is_last);
    if (hn::AllTrue(D(), is_done)) break;
  }
  return t;
}

// Finds the places of the lanes from n on. Returns where they count.
HWY_INLINE M places_at(const PrismNumbers& prism, Interval heights, double least_share, PrismRow& row, size_t n) {
  const D d;
  const Vecs q = minus({hn::Load(d, row.x.data() + n), hn::Load(d, row.y.data() + n), hn::Load(d, row.z.data() + n)},
                       same(prism.x0));
  const Cubic cubic{dot(q, same(prism.c0)), hn::Sub(dot(q, same(prism.c1)), number(ombre::dot(prism.w0, prism.c0))),
                    hn::Sub(dot(q, same(prism.c2)), number(ombre::dot(prism.w0, prism.c1))),
                    number(-ombre::dot(prism.w0, prism.c2))};
  const V zero = hn::Zero(d);
  const M is_beyond = hn::Or(hn::Lt(cubic.at(number(heights.lo)), zero), hn::Gt(cubic.at(number(heights.hi)), zero));
  if (hn::AllTrue(d, is_beyond)) return hn::Gt(zero, zero);
  const V t = root_of(cubic, heights);
  const Vecs e1 = moved(prism.e1, prism.m1, t), e2 = moved(prism.e2, prism.m2, t), normal = cross(e1, e2);
  const Vecs way = minus(q, times(t, same(prism.w0)));
  const V squared = dot(normal, normal);
  const V second = hn::Div(dot(cross(way, e2), normal), squared), third = hn::Div(dot(cross(e1, way), normal), squared);
  hn::Store(second, d, row.second.data() + n);
  hn::Store(third, d, row.third.data() + n);
  hn::Store(t, d, row.height.data() + n);
  const V first = hn::Sub(hn::Sub(number(1), second), third), least = number(least_share);
  const M is_inside = hn::And(hn::Gt(first, least), hn::And(hn::Gt(second, least), hn::Gt(third, least)));
  return hn::AndNot(is_beyond, is_inside);
}

size_t places_here(const PrismNumbers& prism, Interval heights, double least_share, PrismRow& row, size_t count) {
  const D d;
  for (size_t n = 0; n < count; n += hn::Lanes(d)) {
    const M counts = places_at(prism, heights, least_share, row, n);
    const intptr_t first_other = hn::FindFirstTrue(d, hn::Not(counts));
    if (first_other >= 0) return std::min(count, n + static_cast<size_t>(first_other));
  }
  return count;
}

void slopes_here(const PrismNumbers& prism, PrismRow& row, size_t count) {
  const D d;
  for (size_t n = 0; n < count; n += hn::Lanes(d)) {
    const V t = hn::Load(d, row.height.data() + n);
    const Vecs e1 = moved(prism.e1, prism.m1, t), e2 = moved(prism.e2, prism.m2, t), normal = cross(e1, e2);
    const Vecs way = plus(plus(same(prism.w0), times(hn::Load(d, row.second.data() + n), same(prism.m1))),
                          times(hn::Load(d, row.third.data() + n), same(prism.m2)));
    const V inverse = hn::Div(number(1), dot(normal, way));
    const auto store = [&](size_t first, const Vecs& v) {
      hn::Store(hn::Mul(inverse, v.x), d, row.slopes[first].data() + n);
      hn::Store(hn::Mul(inverse, v.y), d, row.slopes[first + 1].data() + n);
      hn::Store(hn::Mul(inverse, v.z), d, row.slopes[first + 2].data() + n);
    };
    store(0, cross(e2, way));
    store(3, cross(way, e1));
    store(6, normal);
  }
}

}  // namespace

PrismKernels prism_kernels_here() { return {places_here, slopes_here}; }

}  // namespace ombre::importing::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ombre::importing {
namespace {

const PrismKernels& best_kernels() {
  static const PrismKernels best = prism_kernels().front();
  return best;
}

}  // namespace

std::vector<PrismKernels> prism_kernels() {
  return sets_for_processor<PrismKernels>(
      {
#if HWY_ARCH_X86
        {&InstructionSets::avx512, N_AVX3::prism_kernels_here}, {&InstructionSets::avx2, N_AVX2::prism_kernels_here},
#endif
      },
      HWY_STATIC_DISPATCH(prism_kernels_here));
}

size_t find_places(const PrismNumbers& prism, Interval heights, double least_share, PrismRow& row, size_t count) {
  return best_kernels().places(prism, heights, least_share, row, count);
}

void find_slopes(const PrismNumbers& prism, PrismRow& row, size_t count) { best_kernels().slopes(prism, row, count); }

}  // namespace ombre::importing
#endif

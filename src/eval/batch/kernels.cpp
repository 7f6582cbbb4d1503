#include "eval/batch/kernels.h"

#include <array>

#include "base/system/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "eval/batch/kernels.cpp"
#define HWY_DISABLED_TARGETS OMBRE_SETS_WITHOUT_SLEEF
#include <hwy/foreach_target.h>
//
#include "eval/batch/intervals-inl.h"
#include "eval/batch/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ombre::eval {
namespace HWY_NAMESPACE {
namespace {

using batch::D;
using batch::M;
using batch::V;
using program::Op;
namespace hn = hwy::HWY_NAMESPACE;

template <Op op>
HWY_INLINE V plain(V a, [[maybe_unused]] V b, [[maybe_unused]] V c) {
#define OMBRE_CALL_1(name) batch::name(a)
#define OMBRE_CALL_2(name) batch::name(a, b)
#define OMBRE_CALL_3(name) batch::name(a, b, c)
#define OMBRE_ROW(name, arity) \
  if constexpr (op == Op::name) return OMBRE_CALL_##arity(name);
  OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
#undef OMBRE_CALL_1
#undef OMBRE_CALL_2
#undef OMBRE_CALL_3
}

// Makes the result NaN if an operand is NaN, unless the other operands alone determine it.
template <Op op>
HWY_INLINE V with_unknowns(V a, V b, V c) {
  const M nan_a = batch::is_nan(a), nan_b = batch::is_nan(b);
  const V result = plain<op>(a, b, c);
  if constexpr (op == Op::select) return batch::nan_where(nan_a, result);
  if constexpr (op == Op::logical_and) {
    const M decided = hn::Or(hn::Eq(a, hn::Zero(D())), hn::Eq(b, hn::Zero(D())));
    return batch::nan_where(hn::AndNot(decided, hn::Or(nan_a, nan_b)), result);
  }
  if constexpr (op == Op::logical_or) {
    const M decided = hn::Or(hn::AndNot(nan_a, batch::is_set(a)), hn::AndNot(nan_b, batch::is_set(b)));
    return batch::nan_where(hn::AndNot(decided, hn::Or(nan_a, nan_b)), result);
  }
  constexpr bool is_unary = op == Op::truth || op == Op::logical_not || op == Op::is_finite;
  return batch::nan_where(is_unary ? nan_a : hn::Or(nan_a, nan_b), result);
}

// True for ops that do not propagate NaN by themselves.
constexpr bool loses_nan(Op op) {
  return program::gives_truth(op) || op == Op::min || op == Op::max || op == Op::select || op == Op::share ||
         op == Op::pow;
}

template <bool is_number>
HWY_INLINE V load(const float* row, size_t n, V number) {
  if constexpr (is_number) return number;
  return hn::Load(D(), row + n);
}

template <Op op, int arity, unsigned shape, bool unknowns>
void run(const float* a, const float* b, const float* c, float* out, size_t count) {
  constexpr bool a_number = (shape & a_is_number) != 0, b_number = (shape & b_is_number) != 0,
                 c_number = (shape & c_is_number) != 0;
  const V zero = hn::Zero(D());
  const V va = a_number ? hn::Set(D(), *a) : zero, vb = b_number ? hn::Set(D(), *b) : zero,
          vc = c_number ? hn::Set(D(), *c) : zero;
  for (size_t n = 0; n < count; n += hn::Lanes(D())) {
    const V x = load<a_number>(a, n, va);
    V y = x, z = x;
    if constexpr (arity > 1) y = load<b_number>(b, n, vb);
    if constexpr (arity > 2) z = load<c_number>(c, n, vc);
    hn::Store(unknowns ? with_unknowns<op>(x, y, z) : plain<op>(x, y, z), D(), out + n);
  }
}

using Row = std::array<std::array<Kernel, 2>, 8>;  // indexed [shape][unknowns]

template <Op op, int arity, unsigned shape>
constexpr void fill_shape(Row& row) {
  row[shape][0] = run<op, arity, shape, false>;
  row[shape][1] = run<op, arity, shape, loses_nan(op)>;
}

// Fills the shapes of operands. The shape with numbers only is left out, since such an op is not evaluated by rows.
template <Op op, int arity>
constexpr Row make_row() {
  Row row{};
  fill_shape<op, arity, 0>(row);
  if constexpr (arity > 1) {
    fill_shape<op, arity, 1>(row);
    fill_shape<op, arity, 2>(row);
  }
  if constexpr (arity > 2) {
    fill_shape<op, arity, 3>(row);
    fill_shape<op, arity, 4>(row);
    fill_shape<op, arity, 5>(row);
    fill_shape<op, arity, 6>(row);
  }
  return row;
}

Kernel kernel(Op op, unsigned shape, Unknowns unknowns) {
  const size_t possible = unknowns == Unknowns::possible ? 1 : 0;
  switch (op) {
#define OMBRE_ROW(name, arity)                              \
  case Op::name: {                                          \
    static constexpr Row row = make_row<Op::name, arity>(); \
    return row[shape][possible];                            \
  }
    OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
    default:
      return nullptr;
  }
}

void sine_cosine(const float* a, float* sines, float* cosines, size_t count) {
  for (size_t n = 0; n < count; n += hn::Lanes(D())) {
    const batch::SineCosine both = batch::sine_cosine(hn::Load(D(), a + n));
    hn::Store(both.sine, D(), sines + n);
    hn::Store(both.cosine, D(), cosines + n);
  }
}

KernelSet kernel_set() {
  constexpr const char* name = HWY_TARGET <= HWY_AVX3 ? "avx512" : HWY_TARGET == HWY_AVX2 ? "avx2" : "portable";
  return {name, kernel, sine_cosine, intervals::kernel, intervals::hull};
}

}  // namespace
KernelSet kernels_here() { return kernel_set(); }
}  // namespace HWY_NAMESPACE
}  // namespace ombre::eval
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ombre::eval {

const std::vector<KernelSet>& kernel_sets() {
#if OMBRE_WIDE_SLEEF
  // There are no batches on a processor without fused multiply-add.
  static const auto sets = [] {
    auto found = sets_for_processor<KernelSet>(
        {{&InstructionSets::avx512, N_AVX3::kernels_here}, {&InstructionSets::avx2, N_AVX2::kernels_here}},
        HWY_STATIC_DISPATCH(kernels_here));
    if (found.size() == 1) found.clear();
    return found;
  }();
#else
  static const std::vector<KernelSet> sets{HWY_STATIC_DISPATCH(kernels_here)()};
#endif
  return sets;
}

}  // namespace ombre::eval
#endif

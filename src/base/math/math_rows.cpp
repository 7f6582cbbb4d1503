#include "base/math/math_rows.h"

#include "base/math/math.h"
#include "base/system/instruction_sets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/math/math_rows.cpp"
#define HWY_DISABLED_TARGETS OMBRE_SETS_WITHOUT_SLEEF
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ombre::math::HWY_NAMESPACE {
namespace {

// The vector functions are declared here, since SLEEF's header declares only those for instruction sets that the
// compiler may use in the whole file.
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
namespace hn = hwy::HWY_NAMESPACE;
#if HWY_TARGET == HWY_AVX2
using D = hn::FixedTag<double, 4>;
#define OMBRE_SLEEF_RAW __m256d
#define OMBRE_SLEEF_NAME(name) Sleef_cinz_##name##d4_u10avx
#else
using D = hn::FixedTag<double, 8>;
#define OMBRE_SLEEF_RAW __m512d
#define OMBRE_SLEEF_NAME(name) Sleef_cinz_##name##d8_u10avx512fnofma
#endif

template <class F, class One>
void each(F f, One one, const double* in, double* out, size_t count) {
  const D d;
  size_t n = 0;
  for (; n + hn::Lanes(d) <= count; n += hn::Lanes(d)) hn::StoreU(hn::Vec<D>{f(hn::LoadU(d, in + n).raw)}, d, out + n);
  for (; n < count; ++n) out[n] = one(in[n]);
}

#define OMBRE_ROW_FUNCTION(name)                                        \
  extern "C" OMBRE_SLEEF_RAW OMBRE_SLEEF_NAME(name)(OMBRE_SLEEF_RAW);   \
  void name##_row(const double* in, double* out, size_t count) {        \
    constexpr auto one = [](double v) { return ombre::math::name(v); }; \
    each(OMBRE_SLEEF_NAME(name), one, in, out, count);                  \
  }
OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)
#undef OMBRE_ROW_FUNCTION
#undef OMBRE_SLEEF_NAME
#undef OMBRE_SLEEF_RAW

#else

#define OMBRE_ROW_FUNCTION(name)                                          \
  void name##_row(const double* in, double* out, size_t count) {          \
    for (size_t n = 0; n < count; ++n) out[n] = ombre::math::name(in[n]); \
  }
OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)
#undef OMBRE_ROW_FUNCTION

#endif

}  // namespace

RowFunctions row_functions_here() {
#define OMBRE_ROW_FUNCTION(name) name##_row,
  return {OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)};
#undef OMBRE_ROW_FUNCTION
}

}  // namespace ombre::math::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ombre::math {

const std::vector<RowFunctions>& row_functions() {
  static const auto sets = sets_for_processor<RowFunctions>(
      {
#if OMBRE_WIDE_SLEEF
        {&InstructionSets::avx512, N_AVX3::row_functions_here}, {&InstructionSets::avx2, N_AVX2::row_functions_here},
#endif
      },
      HWY_STATIC_DISPATCH(row_functions_here));
  return sets;
}

}  // namespace ombre::math
#endif

// Detects which of Highway's instruction sets the processor has.
//
// Highway's own detection is not used: its library measures the processor's clock for 2.5 ms at each start of a
// program.
#pragma once

// 1 if SLEEF's vector functions can be called from code that enables an instruction set for parts of a file only. SLEEF
// expects vectors in registers; g++ passes them so, but clang passes them in memory unless the instruction set is
// enabled for the whole file.
#if defined(__x86_64__) && !defined(__clang__)
#define OMBRE_WIDE_SLEEF 1
#else
#define OMBRE_WIDE_SLEEF 0
#endif

namespace ombre {

struct InstructionSets {
  // HWY_SSE4, HWY_AVX2 and HWY_AVX3, with all features that they require.
  bool sse4 = false, avx2 = false, avx512 = false;
};

InstructionSets instruction_sets();

}  // namespace ombre

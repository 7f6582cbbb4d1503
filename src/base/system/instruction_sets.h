// Which of the instruction sets that Highway compiles for this processor has.
//
// Highway's own answer is in a library that times the processor's clock for 2.5 ms whenever a program with it starts.
#pragma once

// Whether SLEEF can be handed vectors that only parts of a file may use. It expects them in registers, where g++ passes
// them; clang passes them in memory unless the whole file may use them.
#if defined(__x86_64__) && !defined(__clang__)
#define OMBRE_WIDE_SLEEF 1
#else
#define OMBRE_WIDE_SLEEF 0
#endif

namespace ombre {

struct InstructionSets {
  bool sse4 = false, avx2 = false, avx512 = false;  // HWY_SSE4, HWY_AVX2, HWY_AVX3, with all that each of them asks for
};

InstructionSets instruction_sets();

}  // namespace ombre

// Which of the instruction sets that Highway compiles for this processor has.
//
// Highway's own answer is in a library that times the processor's clock for 2.5 ms whenever a program with it starts.
#pragma once

namespace ombre {

struct InstructionSets {
  bool sse4 = false, avx2 = false, avx512 = false;  // HWY_SSE4, HWY_AVX2, HWY_AVX3, with all that each of them asks for
};

InstructionSets instruction_sets();

}  // namespace ombre

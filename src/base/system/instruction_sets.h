// Detects which of Highway's instruction sets the processor has.
//
// Highway's own detection is not used: its library measures the processor's clock for 2.5 ms at each start of a
// program.
#pragma once

#include <initializer_list>
#include <vector>

// 1 if SLEEF's vector functions can be called from code that enables an instruction set for parts of a file only. SLEEF
// expects vectors in registers; g++ passes them so, but clang passes them in memory unless the instruction set is
// enabled for the whole file.
#if defined(__x86_64__) && !defined(__clang__)
#define OMBRE_WIDE_SLEEF 1
#else
#define OMBRE_WIDE_SLEEF 0
#endif

// The instruction sets for which files with such calls are not compiled, for HWY_DISABLED_TARGETS. Those without fused
// multiply-add are among them.
#if OMBRE_WIDE_SLEEF
#define OMBRE_SETS_WITHOUT_SLEEF (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#else
#define OMBRE_SETS_WITHOUT_SLEEF (HWY_SSSE3 | HWY_SSE4 | HWY_AVX2 | HWY_AVX3 | HWY_AVX3_DL)
#endif

namespace ombre {

struct InstructionSets {
  // HWY_SSE4, HWY_AVX2 and HWY_AVX3, with all features that they require.
  bool sse4 = false, avx2 = false, avx512 = false;
};

InstructionSets instruction_sets();

// Functions that were compiled for an instruction set.
template <class Set>
struct CompiledSet {
  bool InstructionSets::*needed;
  Set (*functions)();
};

// Returns the functions for each instruction set that the processor has, in the order given, and those for any.
template <class Set>
std::vector<Set> sets_for_processor(std::initializer_list<CompiledSet<Set>> compiled, Set (*for_any)()) {
  const InstructionSets has = instruction_sets();
  std::vector<Set> found;
  for (const CompiledSet<Set>& set : compiled)
    if (has.*set.needed) found.push_back(set.functions());
  found.push_back(for_any());
  return found;
}

}  // namespace ombre

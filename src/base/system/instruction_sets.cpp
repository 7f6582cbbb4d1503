#include "base/system/instruction_sets.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace ombre {

#if defined(__x86_64__)

namespace {

bool converts_half_floats() {  // F16C has no name in __builtin_cpu_supports of Clang 14
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}

}  // namespace

InstructionSets instruction_sets() {
  __builtin_cpu_init();
  InstructionSets sets;
  sets.sse4 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("aes");
  sets.avx2 = sets.sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
              __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma") && converts_half_floats();
  sets.avx512 = sets.avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  return sets;
}

#else

InstructionSets instruction_sets() { return {}; }

#endif

}  // namespace ombre

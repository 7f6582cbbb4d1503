// Compares the instruction sets that are detected here with those that Highway detects.
#include "base/system/instruction_sets.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace ombre {
namespace {

TEST(InstructionSets, AreThoseThatHighwayFinds) {
  const InstructionSets found = instruction_sets();
  const int64_t supported = HWY_ARCH_X86 ? hwy::SupportedTargets() : 0;
  EXPECT_EQ(found.sse4, (supported & HWY_SSE4) != 0);
  EXPECT_EQ(found.avx2, (supported & HWY_AVX2) != 0);
  EXPECT_EQ(found.avx512, (supported & HWY_AVX3) != 0);
}

}  // namespace
}  // namespace ombre

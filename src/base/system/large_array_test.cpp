#include "base/system/large_array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace ombre {
namespace {

TEST(LargeArray, HoldsWhatIsPutIntoIt) {
  EXPECT_NE(unset_large_array<int32_t>(0), nullptr);
  for (const size_t count : {size_t{1}, size_t{1000}, (size_t{1} << 19) + 3, (size_t{1} << 20) - 1}) {
    const LargeArray<int32_t> array = unset_large_array<int32_t>(count);
    std::iota(array.get(), array.get() + count, 7);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(array.get()) % alignof(std::max_align_t), 0U);
    for (const size_t n : {size_t{0}, count / 2, count - 1}) EXPECT_EQ(array[n], 7 + static_cast<int32_t>(n));
  }
}

TEST(LargeArray, SaysThatMemoryIsTooSmall) {
  const size_t all = static_cast<size_t>(-1);
  EXPECT_THROW(large_memory(all), std::bad_alloc);
  EXPECT_THROW(unset_large_array<double>(all / 4), std::bad_alloc);
}

}  // namespace
}  // namespace ombre

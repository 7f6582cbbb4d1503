#include "formats/images/equal_bytes.h"

#include <gtest/gtest.h>

#include <random>

namespace ombre::formats {

TEST(EqualBytes, AgreesWithAByteByByteSearch) {
  std::mt19937 random(1);
  EqualBytes equal;
  for (const size_t size : {1, 3, 4, 5, 63, 64, 65, 128, 200, 1000}) {
    for (const uint32_t one_in : {1U, 2U, 8U, 50U}) {
      std::vector<uint8_t> a(size), b(size);
      std::vector<bool> same(size);
      size_t count = 0;
      for (size_t i = 0; i < size; ++i) {
        a[i] = static_cast<uint8_t>(random());
        b[i] = random() % one_in ? a[i] : static_cast<uint8_t>(random());
        same[i] = a[i] == b[i];
        count += same[i];
      }
      equal.compare(a.data(), b.data(), size);
      ASSERT_EQ(equal.size(), size);
      ASSERT_EQ(equal.equal_count(), count);
      for (size_t from = 0; from < size; ++from) {
        size_t end = from;
        while (end < size && same[end]) ++end;
        ASSERT_EQ(equal.stretch_end(from), end);
        size_t begin = from;
        while (begin + 4 <= size && !(same[begin] && same[begin + 1] && same[begin + 2] && same[begin + 3])) ++begin;
        ASSERT_EQ(equal.find_stretch(from), begin + 4 <= size ? begin : size) << size << ' ' << from;
      }
    }
  }
}

}  // namespace ombre::formats

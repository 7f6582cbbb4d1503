// Checks XXH3-128 with seed 0 against published vectors.
#include "base/system/hash.h"

#include <gtest/gtest.h>

#include <set>

namespace ombre {

TEST(Hash, EmptyText) {
  EXPECT_EQ(hash_bytes("").hex(), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hash_bytes(std::string_view{}), hash_bytes(""));
}

TEST(Hash, HexHasThirtyTwoDigits) {
  EXPECT_EQ((Hash{0, 0}.hex()), std::string(32, '0'));
  EXPECT_EQ((Hash{1, 0xabcdef}.hex()), "00000000000000010000000000abcdef");
  EXPECT_EQ((Hash{~uint64_t{0}, ~uint64_t{0}}.hex()), std::string(32, 'f'));
}

TEST(Hash, EveryLengthAndByteCounts) {
  // The lengths cross the thresholds of the algorithm: 16, 128, 240 and 1024 bytes.
  std::set<std::string> seen;
  const std::string zeros(2000, '\0');
  for (size_t size = 0; size <= zeros.size(); ++size)
    seen.insert(hash_bytes(std::string_view(zeros).substr(0, size)).hex());
  EXPECT_EQ(seen.size(), 2001u);
  for (size_t at = 0; at < zeros.size(); ++at) {
    std::string text = zeros;
    text[at] = 1;
    seen.insert(hash_bytes(text).hex());
  }
  EXPECT_EQ(seen.size(), 4001u);
}

}  // namespace ombre

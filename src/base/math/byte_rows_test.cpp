// Compares the functions on rows of bytes with plain loops, for every instruction set of this processor.
#include "base/math/byte_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace ombre {
namespace {

using Bytes = std::vector<uint8_t>;

// Returns stretches of a few values, most of them short.
Bytes random_bytes(size_t count, std::mt19937& random) {
  Bytes bytes;
  while (bytes.size() < count) {
    const size_t length = random() % 8 == 0 ? random() % 70 : 1 + random() % 3;
    bytes.insert(bytes.end(), length, static_cast<uint8_t>(random() % 5));
  }
  bytes.resize(count);
  return bytes;
}

template <class Check>
void with_each_set_and_row(const Check& check) {
  for (size_t set = 0; set < byte_row_set_count(); ++set) {
    use_byte_row_set(set);
    std::mt19937 random(1);
    for (size_t count = 0; count < 300; ++count) check(random_bytes(count, random));
    for (int n = 0; n < 20; ++n) check(random_bytes(20000, random));
  }
  use_byte_row_set(0);
}

bool is_equal(const Bytes& bytes, size_t begin, size_t count) {
  return begin + count <= bytes.size() && std::all_of(bytes.begin() + static_cast<ptrdiff_t>(begin),
                                                      bytes.begin() + static_cast<ptrdiff_t>(begin + count),
                                                      [&](uint8_t byte) { return byte == bytes[begin]; });
}

}  // namespace

TEST(ByteRows, CountsAndStretches) {
  with_each_set_and_row([](const Bytes& bytes) {
    for (uint8_t value = 0; value < 6; ++value)
      ASSERT_EQ(count_equal(bytes, value), static_cast<size_t>(std::ranges::count(bytes, value)));
    size_t repeats = 0;
    for (size_t i = 1; i < bytes.size(); ++i) repeats += bytes[i] == bytes[i - 1];
    ASSERT_EQ(count_repeats(bytes), repeats);
    if (bytes.empty()) return;
    size_t length = 0;
    while (is_equal(bytes, 0, length + 1)) ++length;
    ASSERT_EQ(equal_at_begin(bytes), length);
  });
}

TEST(ByteRows, FindsWhereSixteenAreEqual) {
  with_each_set_and_row([](const Bytes& bytes) {
    const size_t found = find_sixteen_equal(bytes);
    ASSERT_EQ(found % 16, 0);
    if (found + 16 <= bytes.size()) {
      ASSERT_TRUE(is_equal(bytes, found, 16));
    }
    // An earlier stretch may have 16 equal bytes, but not 32.
    for (size_t begin = 0; begin + 32 <= std::min(bytes.size(), found + 16); ++begin)
      ASSERT_FALSE(is_equal(bytes, begin, 32) && begin + 32 <= found) << begin << " " << found;
  });
}

TEST(ByteRows, TellOthers) {
  with_each_set_and_row([](Bytes bytes) {
    constexpr uint8_t all[] = {4, 0, 3, 1, 2};
    ASSERT_TRUE(are_among(bytes, all));
    ASSERT_EQ(are_among(bytes, std::span(all).first(4)), std::ranges::count(bytes, uint8_t{2}) == 0);
    ASSERT_EQ(are_among(bytes, {}), bytes.empty());
    for (const uint8_t other : Bytes{9, 20, 255})
      for (uint8_t& byte : bytes) {
        const uint8_t old = std::exchange(byte, other);
        ASSERT_FALSE(are_among(bytes, all));
        byte = old;
        if (bytes.size() > 300) break;
      }
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(16 * byte);
    constexpr uint8_t alike[] = {64, 0, 48, 16, 32};
    ASSERT_TRUE(are_among(bytes, alike));
    ASSERT_EQ(are_among(bytes, std::span(alike).first(4)), std::ranges::count(bytes, uint8_t{32}) == 0);
  });
}

TEST(ByteRows, NumbersAndWhatBelongsToThem) {
  constexpr uint8_t values[] = {3, 0, 4, 2, 1}, number_of[] = {1, 4, 3, 0, 2};
  std::array<FourBytes, 16> table{};
  for (uint8_t n = 0; n < 16; ++n)
    for (uint8_t k = 0; k < 4; ++k) table[n][k] = static_cast<uint8_t>(n * 16 + 3 * k);
  with_each_set_and_row([&](const Bytes& bytes) {
    Bytes numbers(bytes.size()), expected;
    for (const uint8_t byte : bytes) expected.push_back(number_of[byte]);
    number_bytes(bytes, values, numbers.data());
    ASSERT_EQ(numbers, expected);
    Bytes alike = bytes;
    for (uint8_t& byte : alike) byte = static_cast<uint8_t>(byte + (byte % 2 == 0 ? 16 : 31));
    constexpr uint8_t others[] = {34, 16, 20, 18, 32};
    number_bytes(alike, others, numbers.data());
    ASSERT_EQ(numbers, expected);

    for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<uint8_t>((numbers[i] + i) % 16);
    Bytes result(4 * numbers.size());
    look_up_four_bytes(numbers, table, result.data());
    for (size_t i = 0; i < result.size(); ++i) ASSERT_EQ(result[i], table[numbers[i / 4]][i % 4]);
  });
}

TEST(ByteRows, PacksTwoBits) {
  const DoubleBits bits{{3, 0, 4}, {1, 2, 3}};
  constexpr uint8_t of[] = {2, 0, 0, 1, 3};
  with_each_set_and_row([&](Bytes bytes) {
    bytes.resize(bytes.size() / 4 * 4);
    Bytes packed(bytes.size() / 4), expected;
    for (size_t i = 0; i < bytes.size(); i += 4)
      expected.push_back(
          static_cast<uint8_t>(of[bytes[i]] << 6 | of[bytes[i + 1]] << 4 | of[bytes[i + 2]] << 2 | of[bytes[i + 3]]));
    pack_double_bits(bytes.data(), bits, packed);
    ASSERT_EQ(packed, expected);
  });
}

}  // namespace ombre

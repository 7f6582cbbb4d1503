#include "formats/containers/huffman.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace ombre::formats {
namespace {

std::vector<uint8_t> lengths_for(const std::vector<uint32_t>& counts, unsigned longest) {
  std::vector<uint8_t> lengths(counts.size());
  choose_code_lengths(counts, longest, lengths);
  return lengths;
}

// Returns the share of the code space that the codes use (Kraft's sum); 1 for a complete code.
double share(const std::vector<uint8_t>& lengths) {
  double sum = 0;
  for (const uint8_t length : lengths)
    if (length > 0) sum += std::exp2(-length);
  return sum;
}

double mean_length(const std::vector<uint32_t>& counts, const std::vector<uint8_t>& lengths) {
  double sum = 0;
  for (size_t i = 0; i < counts.size(); ++i) sum += static_cast<double>(counts[i]) * lengths[i];
  return sum / std::accumulate(counts.begin(), counts.end(), 0.0);
}

double entropy(const std::vector<uint32_t>& counts) {
  const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
  double sum = 0;
  for (const uint32_t count : counts)
    if (count > 0) sum -= count / total * std::log2(count / total);
  return sum;
}

}  // namespace

TEST(Huffman, CodesAreCompleteAndWithinABitOfTheEntropy) {
  std::mt19937 random(1);
  for (const size_t size : {2, 3, 19, 30, 286}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::vector<uint32_t> counts(size);
      for (uint32_t& count : counts) count = 1 + static_cast<uint32_t>(random() % 1000);
      const std::vector<uint8_t> lengths = lengths_for(counts, 15);
      EXPECT_EQ(share(lengths), 1);
      EXPECT_GE(mean_length(counts, lengths), entropy(counts) - 1e-9);
      EXPECT_LT(mean_length(counts, lengths), entropy(counts) + 1);
    }
  }
}

TEST(Huffman, DyadicCountsGetTheirEntropy) {
  const std::vector<uint32_t> counts = {8, 0, 4, 2, 1, 1};
  EXPECT_EQ(lengths_for(counts, 15), (std::vector<uint8_t>{1, 0, 2, 3, 4, 4}));
}

TEST(Huffman, LengthsStayWithinTheirBound) {
  // Fibonacci numbers give the deepest trees.
  std::vector<uint32_t> counts = {1, 1};
  while (counts.size() < 40) counts.push_back(counts[counts.size() - 1] + counts[counts.size() - 2]);
  EXPECT_EQ(*std::max_element(counts.begin(), counts.end()), 102334155U);
  for (const unsigned longest : {6U, 7U, 14U, 15U}) {
    const std::vector<uint8_t> lengths = lengths_for(counts, longest);
    EXPECT_EQ(*std::max_element(lengths.begin(), lengths.end()), longest);
    EXPECT_EQ(share(lengths), 1);
    EXPECT_TRUE(std::is_sorted(lengths.rbegin(), lengths.rend()));
  }
}

TEST(Huffman, ALoneSymbolTakesABit) {
  EXPECT_EQ(lengths_for({0, 7, 0}, 15), (std::vector<uint8_t>{0, 1, 0}));
  EXPECT_EQ(lengths_for({0, 0, 0}, 15), (std::vector<uint8_t>{0, 0, 0}));
}

TEST(Huffman, CodesFollowTheExampleOfTheStandard) {
  // The example of RFC 1951, 3.2.2, has the codes 010 011 100 101 110 00 1110 1111; here their first bit is the lowest.
  const std::vector<uint8_t> lengths = {3, 3, 3, 3, 3, 2, 4, 4};
  std::vector<uint16_t> codes(lengths.size());
  assign_codes(lengths, codes);
  EXPECT_EQ(codes, (std::vector<uint16_t>{0b010, 0b110, 0b001, 0b101, 0b011, 0b00, 0b0111, 0b1111}));
}

}  // namespace ombre::formats

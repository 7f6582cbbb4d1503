#include "formats/containers/huffman.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/system/assert.h"

namespace ombre::formats {
namespace {

constexpr unsigned most_bits = 15;

// Returns the symbols that occur, the rarest first.
std::vector<uint16_t> by_count(std::span<const uint32_t> counts) {
  std::vector<uint16_t> symbols;
  for (size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0) symbols.push_back(static_cast<uint16_t>(i));
  std::sort(symbols.begin(), symbols.end(),
            [&](uint16_t a, uint16_t b) { return counts[a] != counts[b] ? counts[a] < counts[b] : a < b; });
  return symbols;
}

// Returns the depths of the leaves, which are sorted by weight, in the optimal tree.
std::vector<unsigned> tree_depths(const std::vector<uint64_t>& leaves) {
  const size_t n = leaves.size();
  std::vector<uint64_t> weights(leaves);
  std::vector<size_t> parents(2 * n - 1);
  size_t leaf = 0, inner = n;
  // Leaves and inner nodes are each in ascending order, so the lightest node is the next of one of them.
  const auto take_lightest = [&] {
    return leaf < n && (inner == weights.size() || weights[leaf] <= weights[inner]) ? leaf++ : inner++;
  };
  while (weights.size() < 2 * n - 1) {
    const size_t a = take_lightest(), b = take_lightest();
    parents[a] = parents[b] = weights.size();
    weights.push_back(weights[a] + weights[b]);
  }
  std::vector<unsigned> depths(2 * n - 1);
  for (size_t node = 2 * n - 2; node-- > 0;) depths[node] = depths[parents[node]] + 1;
  depths.resize(n);
  return depths;
}

using LengthCounts = std::array<int, most_bits + 1>;  // number of codes of each length

// Limits depths to `longest`, and lengthens the codes on the next higher levels to make room.
LengthCounts bounded(const std::vector<unsigned>& depths, unsigned longest) {
  LengthCounts counts{};
  for (const unsigned depth : depths) ++counts[std::clamp(depth, 1U, longest)];
  // The excess is in units of the longest code's share of the code space.
  int64_t excess = -(int64_t{1} << longest);
  for (unsigned length = 1; length <= longest; ++length) excess += int64_t{counts[length]} << (longest - length);
  for (; excess > 0; --excess) {
    unsigned length = longest - 1;
    while (counts[length] == 0) --length;
    // One code moves down a level, and a code of the deepest level becomes its sibling.
    --counts[length];
    counts[length + 1] += 2;
    --counts[longest];
  }
  return counts;
}

uint16_t reversed(unsigned code, unsigned length) {
  unsigned result = 0;
  for (unsigned i = 0; i < length; ++i) result |= (code >> i & 1) << (length - 1 - i);
  return static_cast<uint16_t>(result);
}

}  // namespace

void choose_code_lengths(std::span<const uint32_t> counts, unsigned longest, std::span<uint8_t> lengths) {
  ASSERT(longest <= most_bits && lengths.size() == counts.size());
  std::fill(lengths.begin(), lengths.end(), uint8_t{0});
  const std::vector<uint16_t> symbols = by_count(counts);
  if (symbols.empty()) return;
  std::vector<uint64_t> leaves;
  for (const uint16_t symbol : symbols) leaves.push_back(counts[symbol]);
  const LengthCounts of_length = bounded(tree_depths(leaves), longest);
  size_t next = 0;
  for (unsigned length = longest; length > 0; --length)
    for (int i = 0; i < of_length[length]; ++i) lengths[symbols[next++]] = static_cast<uint8_t>(length);
}

void assign_codes(std::span<const uint8_t> lengths, std::span<uint16_t> codes) {
  std::array<unsigned, most_bits + 2> of_length{}, next{};
  for (const uint8_t length : lengths) of_length[length] += length > 0;
  for (unsigned length = 1; length <= most_bits; ++length) next[length + 1] = (next[length] + of_length[length]) << 1;
  for (size_t i = 0; i < lengths.size(); ++i)
    codes[i] = lengths[i] ? reversed(next[lengths[i]]++, lengths[i]) : uint16_t{0};
}

}  // namespace ombre::formats

#include "formats/images/difference_guess.h"

#include <vector>

#include "base/math/math.h"

namespace ombre::formats {
namespace {

constexpr uint64_t rows_a_sample = 16;
constexpr size_t most_counted = size_t{1} << 16;
constexpr double clearly = 0.9;

// Most counts are small, and a table is faster than a logarithm.
double log2_of(uint32_t count) {
  static const std::vector<double> known = [] {
    std::vector<double> values(2048);
    for (size_t n = 1; n < values.size(); ++n) values[n] = math::log2(static_cast<double>(n));
    return values;
  }();
  return count < known.size() ? known[count] : math::log2(static_cast<double>(count));
}

}  // namespace

bool DifferenceGuess::pays(const uint8_t* row, const uint8_t* above, size_t size) {
  if (rows_++ % rows_a_sample != 0) return pays_;
  count(
      size, [&](size_t i) { return row[i]; }, plain_);
  count(
      size, [&](size_t i) { return static_cast<uint8_t>(row[i] - above[i]); }, difference_);
  total_ += size;
  pays_ = bits(difference_) < clearly * bits(plain_);
  if (total_ > most_counted) forget_half();
  return pays_;
}

// Counts the bytes that differ from a neighbour; the others lie in stretches, which need almost no space. There is no
// branch, because every second one would be mispredicted.
template <class At>
void DifferenceGuess::count(size_t size, At at, Counts& counts) {
  if (size == 0) return;
  uint8_t before = 0, value = at(0);
  bool is_edge = true;
  for (size_t i = 0; i + 1 < size; ++i) {
    const uint8_t next = at(i + 1);
    counts[value] += static_cast<uint32_t>(is_edge | (value != before) | (value != next));
    is_edge = false;
    before = value;
    value = next;
  }
  ++counts[value];
}

// Returns the number of bits of an optimal code for the counts.
double DifferenceGuess::bits(const Counts& counts) {
  double total = 0, sum = 0;
  for (const uint32_t count : counts) {
    if (count == 0) continue;
    const auto n = static_cast<double>(count);
    total += n;
    sum -= n * log2_of(count);
  }
  return total > 0 ? sum + total * math::log2(total) : 0;
}

void DifferenceGuess::forget_half() {
  for (uint32_t& count : plain_) count /= 2;
  for (uint32_t& count : difference_) count /= 2;
  total_ /= 2;
}

}  // namespace ombre::formats

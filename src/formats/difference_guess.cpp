#include "formats/difference_guess.h"

#include "base/math.h"

namespace ombre::formats {
namespace {

constexpr uint64_t rows_a_sample = 16;
constexpr size_t most_counted = size_t{1} << 16;
constexpr double clearly = 0.9;

}  // namespace

bool DifferenceGuess::pays(const uint8_t* row, const uint8_t* above, size_t size) {
  if (rows_++ % rows_a_sample != 0) return pays_;
  for (size_t i = 0; i < size; ++i) {
    ++plain_[row[i]];
    ++difference_[static_cast<uint8_t>(row[i] - above[i])];
  }
  total_ += size;
  pays_ = bits(difference_) < clearly * bits(plain_);
  if (total_ > most_counted) forget_half();
  return pays_;
}

// Of a code that suits the counts.
double DifferenceGuess::bits(const Counts& counts) {
  double total = 0, sum = 0;
  for (const uint32_t count : counts) {
    if (count == 0) continue;
    const auto n = static_cast<double>(count);
    total += n;
    sum -= n * math::log2(n);
  }
  return total > 0 ? sum + total * math::log2(total) : 0;
}

void DifferenceGuess::forget_half() {
  for (uint32_t& count : plain_) count /= 2;
  for (uint32_t& count : difference_) count /= 2;
  total_ /= 2;
}

}  // namespace ombre::formats

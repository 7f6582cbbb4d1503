// Estimates whether rows need fewer bytes as differences to the rows above, from the frequencies of bytes outside of
// stretches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ombre::formats {

// A dithered layer may have many materials, but only few at each place. Then the rows look like noise of all of them,
// but their differences to the rows above are noise of few numbers.
class DifferenceGuess {
 public:
  // Returns the estimate for the next row of a layer, from samples of the last rows.
  bool pays(const uint8_t* row, const uint8_t* above, size_t size);

 private:
  using Counts = std::array<uint32_t, 256>;
  template <class At>
  static void count(size_t size, At at, Counts& counts);
  static double bits(const Counts& counts);
  void forget_half();

  Counts plain_{}, difference_{};
  size_t total_ = 0;
  uint64_t rows_ = 0;
  bool pays_ = false;
};

}  // namespace ombre::formats

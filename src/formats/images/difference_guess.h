// Whether rows take fewer bytes as differences to those above, by how often bytes outside of stretches occur.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ombre::formats {

// Where each place has but a few of many materials, dithered rows look like noise of all of them, but the difference
// to the row above is noise of a few numbers.
class DifferenceGuess {
 public:
  // For the next of a layer's rows, from some of the last ones.
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

// Writes gzip streams (RFC 1952) of grids of numbers, piece by piece.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// Finds repeats of the preceding number and of the number in the preceding row. The bytes depend only on the numbers.
class GzipWriter {
 public:
  // Constructs a writer for numbers of `number_bytes` in rows of `row_bytes`.
  GzipWriter(size_t number_bytes, size_t row_bytes);

  void add(const uint8_t* bytes, size_t count);
  void finish();
  // Returns the bytes that are ready and have not been returned yet.
  std::string take();

 private:
  // Returns the number of bytes from `at` on that equal those `distance` earlier.
  size_t repeated(size_t at, size_t distance, size_t end) const;
  void put(size_t begin);

  std::string out_;
  DeflateWriter deflate_;
  std::vector<uint32_t> distances_;  // distances at which repeats are searched for
  std::vector<uint8_t> bytes_;       // up to a window of earlier bytes, then those being added
  uint32_t sum_ = 0, size_ = 0;      // CRC-32; number of bytes modulo 2^32
};

}  // namespace ombre::formats

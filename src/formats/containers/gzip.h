// Gzip streams (RFC 1952) of grids of numbers, piece by piece.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// Finds what repeats the number before it or the one in the row before. The bytes depend on the numbers alone.
class GzipWriter {
 public:
  // Numbers have `number_bytes`, rows `row_bytes`.
  GzipWriter(size_t number_bytes, size_t row_bytes);

  void add(const uint8_t* bytes, size_t count);
  void finish();
  // What is ready to be written; the caller gets it once.
  std::string take();

 private:
  // How many bytes from `at` on equal those `distance` before.
  size_t repeated(size_t at, size_t distance, size_t end) const;
  void put(size_t begin);

  std::string out_;
  DeflateWriter deflate_;
  std::vector<uint32_t> distances_;  // at which repeats are looked for
  std::vector<uint8_t> bytes_;       // up to a window of those before, then those being added
  uint32_t sum_ = 0, size_ = 0;      // CRC-32; bytes modulo 2^32
};

}  // namespace ombre::formats

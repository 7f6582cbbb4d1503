// The data of an image: a deflate stream with zlib's header and checksum.
#pragma once

#include <array>
#include <cstdint>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// The checksum of zlib (RFC 1950, 9). Repeated pixels are added by a formula.
class Adler32 {
 public:
  void add(const uint8_t* bytes, size_t count);
  void add_repeated(std::array<uint8_t, 4> pixel, uint32_t times);
  uint32_t value() const { return sum_; }

 private:
  uint32_t sum_ = 1;
};

// The stream and its checksum: a writer adds each byte to `sum` and its encoding to `deflate`.
struct ZlibStream {
  Adler32 sum;
  DeflateWriter deflate;
};

}  // namespace ombre::formats

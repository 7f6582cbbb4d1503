// What goes into the data of an image: a deflate stream with zlib's header and checksum around it.
#pragma once

#include <array>
#include <cstdint>

#include "formats/containers/deflate.h"

namespace ombre::formats {

// The checksum of zlib (RFC 1950, 9). Repeated pixels count by formula.
class Adler32 {
 public:
  void add(const uint8_t* bytes, size_t count);
  void add_repeated(std::array<uint8_t, 4> pixel, uint32_t times);
  uint32_t value() const { return sum_; }

 private:
  uint32_t sum_ = 1;
};

// Whoever writes tells both what the bytes are and how to deflate them.
struct ZlibStream {
  Adler32 sum;
  DeflateWriter deflate;
};

}  // namespace ombre::formats

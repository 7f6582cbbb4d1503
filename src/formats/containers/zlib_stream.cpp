#include "formats/containers/zlib_stream.h"

#include <libdeflate.h>

namespace ombre::formats {
namespace {

constexpr uint64_t modulus = 65521;

}  // namespace

void Adler32::add(const uint8_t* bytes, size_t count) { sum_ = libdeflate_adler32(sum_, bytes, count); }

void Adler32::add_repeated(std::array<uint8_t, 4> pixel, uint32_t times) {
  // `low` sums the bytes, `high` sums `low` after each byte. One pixel adds `sum` to the first and 4 low + `weighted`
  // to the second.
  const uint64_t low = sum_ & 0xFFFF, high = sum_ >> 16, n = times;
  const uint64_t p = pixel[0], q = pixel[1], r = pixel[2], s = pixel[3];
  const uint64_t sum = p + q + r + s, weighted = 4 * p + 3 * q + 2 * r + s;
  const uint64_t pairs = n % 2 == 0 ? n / 2 % modulus * ((n - 1) % modulus) : n % modulus * ((n - 1) / 2 % modulus);
  const uint64_t new_low = (low + n % modulus * sum) % modulus;
  const uint64_t new_high = (high + n % modulus * (4 * low + weighted) + pairs % modulus * (4 * sum)) % modulus;
  sum_ = static_cast<uint32_t>(new_high << 16 | new_low);
}

}  // namespace ombre::formats

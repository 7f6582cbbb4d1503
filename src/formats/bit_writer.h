// Bits into bytes, the lowest bit first, as deflate wants them.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace ombre::formats {

class BitWriter {
 public:
  // Room for so many more bytes; `put` does not look.
  void reserve(size_t bytes) { bytes_.resize(size_ + bytes + sizeof bits_); }

  // At most 56 bits; those above `count` are zero.
  void put(uint64_t bits, unsigned count) {
    static_assert(std::endian::native == std::endian::little);
    bits_ |= bits << bit_count_;
    bit_count_ += count;
    std::memcpy(bytes_.data() + size_, &bits_, sizeof bits_);
    const unsigned whole_bytes = bit_count_ / 8;
    size_ += whole_bytes;
    bits_ >>= 8 * whole_bytes;
    bit_count_ %= 8;
  }
  void fill_byte() { put(0, (8 - bit_count_) % 8); }

  // The whole bytes so far.
  const uint8_t* data() const { return bytes_.data(); }
  size_t size() const { return size_; }
  void clear() { size_ = 0; }

 private:
  std::vector<uint8_t> bytes_;  // longer than `size_`
  size_t size_ = 0;
  uint64_t bits_ = 0;
  unsigned bit_count_ = 0;  // below 8 between calls
};

}  // namespace ombre::formats

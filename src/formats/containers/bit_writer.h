// Writes bits into bytes, the lowest bit first, as deflate requires.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace ombre::formats {

// A cursor that writes into memory of its caller. It is meant to be a local variable, so that it stays in registers.
class BitCursor {
 public:
  static constexpr unsigned most_bits = 56;

  explicit BitCursor(uint8_t* at, uint64_t bits = 0, unsigned bit_count = 0)
      : at_(at), bits_(bits), bit_count_(bit_count) {}

  // Writes at most most_bits bits; bits above `count` must be zero. Up to eight bytes may be overwritten.
  void put(uint64_t bits, unsigned count) {
    static_assert(std::endian::native == std::endian::little);
    bits_ |= bits << bit_count_;
    bit_count_ += count;
    std::memcpy(at_, &bits_, sizeof bits_);
    const unsigned whole_bytes = bit_count_ / 8;
    at_ += whole_bytes;
    bits_ >>= 8 * whole_bytes;
    bit_count_ %= 8;
  }

  uint8_t* at() const { return at_; }
  uint64_t bits() const { return bits_; }
  unsigned bit_count() const { return bit_count_; }

 private:
  uint8_t* at_;
  uint64_t bits_;
  unsigned bit_count_;  // less than 8 between calls
};

// Writes bits into its own memory.
class BitWriter {
 public:
  // Reserves room for this many more bytes; put() does not check for room.
  void reserve(size_t bytes) { bytes_.resize(size_ + bytes + sizeof bits_); }

  void put(uint64_t bits, unsigned count) {
    BitCursor cursor = begin();
    cursor.put(bits, count);
    end(cursor);
  }
  void fill_byte() { put(0, (8 - bit_count_) % 8); }

  // Returns a cursor for many bits at once; they become part of the data when end() is called.
  BitCursor begin() { return BitCursor(bytes_.data() + size_, bits_, bit_count_); }
  void end(const BitCursor& cursor) {
    size_ = static_cast<size_t>(cursor.at() - bytes_.data());
    bits_ = cursor.bits();
    bit_count_ = cursor.bit_count();
  }

  // Returns the complete bytes so far.
  const uint8_t* data() const { return bytes_.data(); }
  size_t size() const { return size_; }
  void clear() { size_ = 0; }

 private:
  std::vector<uint8_t> bytes_;  // longer than `size_`
  size_t size_ = 0;
  uint64_t bits_ = 0;
  unsigned bit_count_ = 0;
};

}  // namespace ombre::formats

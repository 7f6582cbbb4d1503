// Functions on rows of bytes that each instruction set implements; byte_rows.h documents them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ombre {

struct DoubleBits {
  std::array<uint8_t, 3> from{}, to{};
};
using FourBytes = std::array<uint8_t, 4>;

struct ByteRowSet {
  size_t (*count_equal)(const uint8_t* bytes, size_t count, uint8_t value);
  size_t (*count_repeats)(const uint8_t* bytes, size_t count);  // reads bytes[count] too
  bool (*are_among)(const uint8_t* bytes, size_t count, const uint8_t* values, size_t value_count);
  size_t (*equal_at_begin)(const uint8_t* bytes, size_t count);
  size_t (*find_sixteen_equal)(const uint8_t* bytes, size_t count);
  void (*pack_double_bits)(const uint8_t* bytes, const DoubleBits& bits, uint8_t* packed, size_t packed_count);
  void (*number_bytes)(const uint8_t* bytes, size_t count, const uint8_t* values, size_t value_count, uint8_t* numbers);
  void (*look_up_four_bytes)(const uint8_t* numbers, size_t count, const FourBytes* table, uint8_t* bytes);
};

}  // namespace ombre

// The alphabets of deflate (RFC 1951, 3.2.5): the symbol and extra bits of a length or a distance.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace ombre::formats {

constexpr unsigned end_of_block = 256, first_length_symbol = 257, length_symbol_count = 29;
constexpr unsigned literal_symbol_count = first_length_symbol + length_symbol_count, distance_symbol_count = 30;
constexpr uint32_t longest_match = 258;

struct Symbol {
  uint8_t index = 0;  // counted from the first length or distance symbol
  uint8_t extra_count = 0;
  uint16_t extra = 0;
};

// Returns the symbol of a value: from the third doubling on, each doubling of the value has `1 << split` symbols.
constexpr Symbol split_symbol(uint32_t value, unsigned split) {
  const unsigned top = static_cast<unsigned>(std::bit_width(value >> split));
  const unsigned extra_count = top > 1 ? top - 1 : 0;
  return {static_cast<uint8_t>((extra_count << split) + (value >> extra_count)), static_cast<uint8_t>(extra_count),
          static_cast<uint16_t>(value & ((1U << extra_count) - 1))};
}

// Returns the symbol of a length from 3 to 258; the longest has its own symbol.
constexpr Symbol length_symbol(uint32_t length) {
  return length == longest_match ? Symbol{length_symbol_count - 1, 0, 0} : split_symbol(length - 3, 2);
}

// Returns the symbol of a distance from 1 to 32768.
constexpr Symbol distance_symbol(uint32_t distance) { return split_symbol(distance - 1, 1); }

}  // namespace ombre::formats

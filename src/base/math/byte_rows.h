// Rows of bytes, in SIMD: what stands in them, and packed. The same on every processor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/math/byte_row_set.h"

namespace ombre {

size_t count_equal(std::span<const uint8_t> bytes, uint8_t value);

// How many equal the one before.
size_t count_repeats(std::span<const uint8_t> bytes);

bool are_among(std::span<const uint8_t> bytes, std::span<const uint8_t> values);

// How many at the begin are equal, of one at least.
size_t equal_at_begin(std::span<const uint8_t> bytes);

// From some multiple of 16 on 16 bytes are equal: the first, or one behind it if the byte that follows there differs.
// It is before the end of the first 32 bytes that are equal. Without one, less than 16 bytes before the end.
size_t find_sixteen_equal(std::span<const uint8_t> bytes);

// Two bits for each byte that is `from[n]`, those of `to[n]`, and 0 for the others. Four make a byte of `packed`, the
// first one above.
void pack_double_bits(const uint8_t* bytes, const DoubleBits& bits, std::span<uint8_t> packed);

// Which of `values` each byte is, counted from 0; every byte is one of them. As many numbers as bytes, which they may
// replace.
void number_bytes(std::span<const uint8_t> bytes, std::span<const uint8_t> values, uint8_t* numbers);

// Four bytes for each number, which are below 16.
void look_up_four_bytes(std::span<const uint8_t> numbers, const std::array<FourBytes, 16>& table, uint8_t* bytes);

// For tests: the instruction sets that this processor has for these, of which the first is used, and the use of another
// one, while nobody else is at it.
size_t byte_row_set_count();
void use_byte_row_set(size_t set);

}  // namespace ombre

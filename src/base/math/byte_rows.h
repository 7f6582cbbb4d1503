// SIMD functions that search, count, translate and pack rows of bytes. Results do not depend on the processor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/math/byte_row_set.h"

namespace ombre {

size_t count_equal(std::span<const uint8_t> bytes, uint8_t value);

// Returns the number of bytes that equal the byte before them.
size_t count_repeats(std::span<const uint8_t> bytes);

bool are_among(std::span<const uint8_t> bytes, std::span<const uint8_t> values);

// Returns the number of equal bytes at the start of the row, which must not be empty.
size_t equal_at_begin(std::span<const uint8_t> bytes);

// Returns the first multiple of 16 from which 16 bytes are equal, or a later one if the byte after those 16 differs.
// The result lies before the end of the first 32 equal bytes. If there is no such place, fewer than 16 bytes follow the
// result.
size_t find_sixteen_equal(std::span<const uint8_t> bytes);

// Writes two bits for each byte: `bits.to[n]` if the byte is `bits.from[n]`, 0 if it is none of them. Four pairs make a
// byte of `packed`, with the first pair in the highest bits.
void pack_double_bits(const uint8_t* bytes, const DoubleBits& bits, std::span<uint8_t> packed);

// Writes the index in `values` of each byte. Every byte must be in `values`. `numbers` has as many bytes as `bytes`,
// and may be the same memory.
void number_bytes(std::span<const uint8_t> bytes, std::span<const uint8_t> values, uint8_t* numbers);

// Writes four bytes for each number. Numbers must be below 16.
void look_up_four_bytes(std::span<const uint8_t> numbers, const std::array<FourBytes, 16>& table, uint8_t* bytes);

// byte_row_set_count(), for tests, returns the number of instruction sets that this processor offers, of which number 0
// is used. use_byte_row_set() switches to another one while no other thread uses these functions.
size_t byte_row_set_count();
void use_byte_row_set(size_t set);

}  // namespace ombre

// Huffman codes of bounded length, in the canonical order of deflate.
#pragma once

#include <cstdint>
#include <span>

namespace ombre::formats {

// Chooses a length for each symbol that occurs and 0 for the others; a single symbol gets 1. Lengths are at most
// `longest` bits, which must suffice for the number of symbols. Equal counts give equal lengths on every machine.
void choose_code_lengths(std::span<const uint32_t> counts, unsigned longest, std::span<uint8_t> lengths);

// Assigns the codes of the given lengths, bit-reversed for writing the lowest bit first.
void assign_codes(std::span<const uint8_t> lengths, std::span<uint16_t> codes);

}  // namespace ombre::formats

#include "formats/images/equal_bytes.h"

#include <bit>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace ombre::formats {
namespace {

// Returns one bit for each of 16 bytes, the first byte's lowest.
#ifdef __SSE2__
uint64_t equal_bits(const uint8_t* a, const uint8_t* b) {
  const __m128i x = _mm_loadu_si128(reinterpret_cast<const __m128i*>(a));
  const __m128i y = _mm_loadu_si128(reinterpret_cast<const __m128i*>(b));
  return static_cast<uint64_t>(_mm_movemask_epi8(_mm_cmpeq_epi8(x, y)));
}
#else
uint64_t equal_bits(const uint8_t* a, const uint8_t* b) {
  uint64_t bits = 0;
  for (unsigned i = 0; i < 16; ++i) bits |= uint64_t{a[i] == b[i]} << i;
  return bits;
}
#endif

// Counts the set bits. Not all processors have an instruction for it, and a table is slower.
size_t count_bits(uint64_t word) {
  constexpr uint64_t pairs = 0x5555555555555555, fours = 0x3333333333333333, bytes = 0x0F0F0F0F0F0F0F0F;
  word -= word >> 1 & pairs;
  word = (word & fours) + (word >> 2 & fours);
  word = (word + (word >> 4)) & bytes;
  return static_cast<size_t>(word * 0x0101010101010101 >> 56);
}

}  // namespace

void EqualBytes::compare(const uint8_t* a, const uint8_t* b, size_t count) {
  size_ = count;
  words_.resize(count / 64 + 2);
  size_t i = 0, word = 0;
  for (; i + 64 <= count; i += 64) {
    uint64_t bits = 0;
    for (size_t k = 0; k < 64; k += 16) bits |= equal_bits(a + i + k, b + i + k) << k;
    words_[word++] = bits;
  }
  uint64_t rest = 0;
  for (size_t k = 0; i + k < count; ++k) rest |= uint64_t{a[i + k] == b[i + k]} << k;
  words_[word++] = rest;
  words_[word] = 0;
}

size_t EqualBytes::equal_count() const {
  size_t count = 0;
  for (const uint64_t word : words_) count += word + 1 < 2 ? word & 64 : count_bits(word);
  return count;
}

size_t EqualBytes::find_stretch(size_t position) const {
  if (position >= size_) return size_;
  uint64_t mask = ~uint64_t{0} << position % 64;
  for (size_t word = position / 64; word + 1 < words_.size(); ++word) {
    const uint64_t here = words_[word] & mask, next = words_[word + 1];
    const uint64_t pairs = here & (here >> 1 | next << 63), next_pairs = next & next >> 1;
    if (const uint64_t fours = pairs & (pairs >> 2 | next_pairs << 62))
      return word * 64 + static_cast<size_t>(std::countr_zero(fours));
    mask = ~uint64_t{0};
  }
  return size_;
}

size_t EqualBytes::stretch_end(size_t position) const {
  size_t word = position / 64;
  uint64_t unset = ~words_[word] >> position % 64 << position % 64;
  while (unset == 0) unset = ~words_[++word];
  return word * 64 + static_cast<size_t>(std::countr_zero(unset));
}

}  // namespace ombre::formats

// Choice of one material from fractions, as a pure function of (seed, i, j, k, composition).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace ombre::voxel {

// A well-mixed permutation of 32-bit integers from the "lowbias32" family, with two multiplications and a bias below
// 0.2 %.
inline uint32_t scramble(uint32_t h) {
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  h ^= h >> 16;
  return h;
}

// Returns the part of the hash that is common to a row.
inline uint32_t row_hash(uint64_t seed, int64_t j, int64_t k) {
  uint32_t h = scramble(static_cast<uint32_t>(seed) ^ scramble(static_cast<uint32_t>(seed >> 32) + 0x632BE5ABu));
  h = scramble(h + static_cast<uint32_t>(k) * 0x9E3779B9u);
  return scramble(h ^ (static_cast<uint32_t>(j) * 0x85EBCA6Bu + 0x27D4EB2Fu));
}

// Returns a uniform integer below 2^24, which floats can hold.
inline uint32_t hashed_draw(uint32_t row, int64_t i) {
  return scramble(row + static_cast<uint32_t>(i) * 0xC2B2AE35u) >> 8;
}

// Returns the index of the first of several ascending thresholds that exceeds the draw u in [0, 1), or their number if
// none does (2023 paper, Algorithm 1).
template <class T>
size_t first_above(std::span<const T> thresholds, T u) {
  size_t n = 0;
  while (n < thresholds.size() && !(u < thresholds[n])) ++n;
  return n;
}

}  // namespace ombre::voxel

// From compositions to single materials: pure functions of (seed, i, j, k, composition).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace ombre::voxel {

// A well-mixed 32-bit permutation (two multiplications, bias below 0.2 %: the "lowbias32" family).
inline uint32_t scramble(uint32_t h) {
  h ^= h >> 16;
  h *= 0x7FEB352Du;
  h ^= h >> 15;
  h *= 0x846CA68Bu;
  h ^= h >> 16;
  return h;
}

// The part of the hash that a row shares.
inline uint32_t row_hash(uint64_t seed, int64_t j, int64_t k) {
  uint32_t h = scramble(static_cast<uint32_t>(seed) ^ scramble(static_cast<uint32_t>(seed >> 32) + 0x632BE5ABu));
  h = scramble(h + static_cast<uint32_t>(k) * 0x9E3779B9u);
  return scramble(h ^ (static_cast<uint32_t>(j) * 0x85EBCA6Bu + 0x27D4EB2Fu));
}

// Uniform in [0, 1), a multiple of 2^-24, so that single and double precision agree.
inline double uniform(uint32_t row, int64_t i) {
  return static_cast<double>(scramble(row + static_cast<uint32_t>(i) * 0xC2B2AE35u) >> 8) * 0x1p-24;
}

// Which fraction the draw u in [0, 1) falls into (2023 paper, Algorithm 1). Fractions that are not
// positive are never picked; the last positive one takes what rounding leaves over.
inline size_t pick(std::span<const double> fractions, double u) {
  double total = 0;
  for (const double f : fractions)
    if (f > 0) total += f;
  double rest = u * total;
  size_t last = 0;
  for (size_t m = 0; m < fractions.size(); ++m) {
    if (!(fractions[m] > 0)) continue;
    if (rest < fractions[m]) return m;
    rest -= fractions[m];
    last = m;
  }
  return last;
}

// The greatest fraction, the first on ties.
inline size_t greatest(std::span<const double> fractions) {
  size_t best = 0;
  for (size_t m = 1; m < fractions.size(); ++m)
    if (fractions[m] > fractions[best]) best = m;
  return best;
}

}  // namespace ombre::voxel

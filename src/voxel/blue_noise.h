// Blue noise in place of white: draws for dithering whose neighbours differ, so that mixtures look even.
//
// A mask of 64 x 64 x 16 voxels repeats through the job. Each of its 65,536 ranks is there once, and each layer has one
// of each 16 that follow each other: over whole tiles a layer keeps a fraction to 1/4096, all layers to 1/65536. Each
// layer alone is blue, and voxels above each other are anticorrelated. There is a mask for square voxels and one for
// voxels that are twice as long as wide (600 x 300 dpi), so that noise is blue in millimetres.
// tools/make_blue_noise.cpp makes them and says how.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/math/pitch.h"
#include "voxel/quantise.h"

namespace ombre::voxel {

inline constexpr uint32_t blue_noise_width = 64, blue_noise_height = 64, blue_noise_depth = 16;  // powers of two

// x fastest, then y, then z; (rank + 1/2) * 256. The second is for voxels that are longer along y.
inline constexpr size_t blue_noise_voxels = size_t{blue_noise_width} * blue_noise_height * blue_noise_depth;
extern const uint32_t blue_noise_draws[blue_noise_voxels], blue_noise_long_draws[blue_noise_voxels];

// The mask that suits voxels with these sides best. It lives as long as the program.
const uint32_t* blue_noise_mask(Pitch x, Pitch y);

// Draws in [0, 2^24) for the voxels of a row, as `uniform` has them once divided by 2^24.
struct BlueNoiseRow {
  const uint32_t* draws = nullptr;  // blue_noise_width of them, one after the other
  uint32_t offset = 0;

  // draws[(i + offset) % 64], also for negative i.
  uint32_t operator[](int64_t i) const { return draws[(static_cast<uint32_t>(i) + offset) % blue_noise_width]; }
};

// A pure function of seed and place: the seed shifts the mask along x, y and z.
inline BlueNoiseRow blue_noise_row(const uint32_t* mask, uint64_t seed, int64_t j, int64_t k) {
  const uint32_t shift = row_hash(seed, 0, 0);
  const uint32_t y = (static_cast<uint32_t>(j) + (shift >> 8)) % blue_noise_height;
  const uint32_t z = (static_cast<uint32_t>(k) + (shift >> 16)) % blue_noise_depth;
  return {mask + size_t{z * blue_noise_height + y} * blue_noise_width, shift % blue_noise_width};
}

}  // namespace ombre::voxel

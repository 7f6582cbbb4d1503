// Blue noise for dithering: neighbouring voxels get different draws, so that mixtures look more even than with white
// noise.
//
// A mask of 64 x 64 x 16 voxels repeats through the job. It contains each of its 65,536 ranks once, and each layer
// contains one of every 16 consecutive ranks. Over whole tiles, a layer keeps a fraction to 1/4096, and all layers
// together to 1/65536. Each layer by itself is blue, and voxels above each other are anticorrelated. One mask is for
// square voxels, and one for voxels twice as long as wide (600 x 300 dpi), whose noise is blue in millimetres.
// tools/make_blue_noise.cpp makes the masks and describes the method.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/math/pitch.h"
#include "voxel/quantise.h"

namespace ombre::voxel {

inline constexpr uint32_t blue_noise_width = 64, blue_noise_height = 64, blue_noise_depth = 16;  // powers of two

// Values (rank + 1/2) * 256, with x varying fastest, then y, then z. The second mask is for voxels that are longer
// along y.
inline constexpr size_t blue_noise_voxels = size_t{blue_noise_width} * blue_noise_height * blue_noise_depth;
extern const uint32_t blue_noise_draws[blue_noise_voxels], blue_noise_long_draws[blue_noise_voxels];

// Returns the mask that suits voxels with these sides best. It lives as long as the program.
const uint32_t* blue_noise_mask(Pitch x, Pitch y);

// Draws in [0, 2^24) for the voxels of a row. Divided by 2^24 they lie in [0, 1).
struct BlueNoiseRow {
  const uint32_t* draws = nullptr;  // blue_noise_width consecutive values
  uint32_t offset = 0;

  // Returns draws[(i + offset) % 64]; i may be negative.
  uint32_t operator[](int64_t i) const { return draws[(static_cast<uint32_t>(i) + offset) % blue_noise_width]; }
};

// Returns the draws of a row as a pure function of seed and position. The seed shifts the mask along x, y and z.
inline BlueNoiseRow blue_noise_row(const uint32_t* mask, uint64_t seed, int64_t j, int64_t k) {
  const uint32_t shift = row_hash(seed, 0, 0);
  const uint32_t y = (static_cast<uint32_t>(j) + (shift >> 8)) % blue_noise_height;
  const uint32_t z = (static_cast<uint32_t>(k) + (shift >> 16)) % blue_noise_depth;
  return {mask + size_t{z * blue_noise_height + y} * blue_noise_width, shift % blue_noise_width};
}

}  // namespace ombre::voxel

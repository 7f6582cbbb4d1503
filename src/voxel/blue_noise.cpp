#include "voxel/blue_noise.h"

#include <numbers>
#include <vector>

namespace ombre::voxel {
namespace {

static_assert(blue_noise_width == blue_noise_height);

// Returns the mask with x and y exchanged.
std::vector<uint32_t> turned(const uint32_t* mask) {
  std::vector<uint32_t> turned(blue_noise_voxels);
  for (size_t n = 0; n < blue_noise_voxels; ++n) {
    const size_t x = n % blue_noise_width, y = n / blue_noise_width % blue_noise_height,
                 layer = n - n % (size_t{blue_noise_width} * blue_noise_height);
    turned[layer + x * blue_noise_width + y] = mask[n];
  }
  return turned;
}

}  // namespace

const uint32_t* blue_noise_mask(Pitch x, Pitch y) {
  static const std::vector<uint32_t> long_along_x = turned(blue_noise_long_draws);
  const double ratio = y.mm() / x.mm();
  if (ratio >= std::numbers::sqrt2) return blue_noise_long_draws;
  return ratio <= 1 / std::numbers::sqrt2 ? long_along_x.data() : blue_noise_draws;
}

}  // namespace ombre::voxel

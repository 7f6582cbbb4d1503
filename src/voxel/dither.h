// Methods of dithering and their names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::voxel {

// The method that chooses one material of a composition. The result is a pure function of (seed, i, j, k, composition),
// except for error diffusion.
enum class Dither {
  stochastic,  // white noise
  blue_noise,  // a mask whose neighbouring values differ (blue_noise.h)
  diffusion,   // error diffusion within a layer (diffusion.h); a pure function of the whole layer
  threshold,   // the greatest fraction wins
};

const std::vector<std::string>& dither_names();
std::string_view name(Dither dither);
std::optional<Dither> dither(std::string_view name);

}  // namespace ombre::voxel

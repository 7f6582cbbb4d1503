// The methods of dithering, by value and by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::voxel {

// How a composition becomes one material. All are pure functions of (seed, i, j, k, composition).
enum class Dither {
  stochastic,  // white noise
  blue_noise,  // a mask whose neighbours differ (blue_noise.h)
  diffusion,   // of errors within a layer (diffusion.h); a pure function of the whole layer
  threshold,   // the greatest fraction takes the voxel
};

const std::vector<std::string>& dither_names();
std::string_view name(Dither dither);
std::optional<Dither> dither(std::string_view name);

}  // namespace ombre::voxel

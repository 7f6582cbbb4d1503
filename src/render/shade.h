// From what rays met to the colours of pixels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/camera.h"
#include "render/ray_cast.h"

namespace ombre::render {

using Rgba8 = std::array<uint8_t, 4>;

Colour linear(Rgba8 srgb);

struct Background {
  Rgba8 top{255, 255, 255, 255}, bottom{255, 255, 255, 255};
  bool is_transparent = false;
};

// Pixels of width / samples x height / samples, RGBA, rows from the top: the mean of samples x samples rays each.
// Light comes from the eye's side, from above on the left.
std::vector<uint8_t> shade(const std::vector<RayHit>& hits, const Film& film, const Camera& camera, int64_t samples,
                           const Background& background);

}  // namespace ombre::render

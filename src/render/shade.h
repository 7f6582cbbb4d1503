// Converts hits of rays to the colours of pixels.
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
// Returns the opaque sRGB colour of a linear one.
Rgba8 encoded(const Colour& linear);

struct Background {
  Rgba8 colour{255, 255, 255, 255};
  bool is_transparent = false;
};

enum class Lighting {
  from_the_eye,  // light from the eye's side, from above on the left
  none,          // the materials' own colours
};

struct ShadeOptions {
  Lighting lighting = Lighting::from_the_eye;
  int64_t samples = 1;  // a pixel is the mean of samples x samples rays
  Background background;
};

// Appends rows [begin, end) of pixels, RGBA from left to right. The band must contain their rays and, with lighting,
// one more row above and below.
void shade(const RayBand& band, const Film& film, const Camera& camera, const ShadeOptions& options, int64_t begin,
           int64_t end, int threads, std::vector<uint8_t>& pixels);

}  // namespace ombre::render

// Images as heights.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/system/hash.h"
#include "program/field_source.h"

namespace ombre::importing {

// Rows from the top; 0 is black, 1 white.
struct GrayImage {
  uint32_t width = 0, height = 0;
  std::vector<float> values;
};

// Channel "value": 0 to 1 at (x, y, any z), in pixels from the left lower corner of the image; between the middles of
// pixels by bilinear interpolation, beyond those at its sides the same as there.
program::SourceField make_height_source(std::string name, GrayImage image, Hash content);

// The greatest difference between neighbours along x and along y.
std::array<double, 2> steepest_steps(const GrayImage& image);

}  // namespace ombre::importing

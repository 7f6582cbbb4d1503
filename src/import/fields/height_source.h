// Images as height fields.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/system/hash.h"
#include "program/field_source.h"

namespace ombre::importing {

// A grey image with its rows from the top; 0 is black, 1 white.
struct GrayImage {
  uint32_t width = 0, height = 0;
  std::vector<float> values;
};

// Returns a source with the channel "value", 0 to 1 at (x, y, any z), in pixels from the lower left corner of the
// image. Values are interpolated bilinearly between the centres of pixels, and constant beyond the outermost centres.
program::SourceField make_height_source(std::string name, GrayImage image, Hash content);

// Returns the greatest difference between neighbours along x and along y.
std::array<double, 2> steepest_steps(const GrayImage& image);

}  // namespace ombre::importing

// Images as field sources.
#pragma once

#include <cstdint>
#include <vector>

#include "program/field_source.h"

namespace ombre::nodes {

struct TextureUse {
  bool repeats = true;     // beside the image; else its border goes on
  bool is_linear = false;  // numbers are light, else as sRGB has them
};

// `rgba` has the rows from the top, four bytes a pixel, in sRGB. The source's space is that of the pixels: x and y
// count them from the left lower corner, so that the middle of the first lies at 0.5. Between the middles it is linear.
// Channels "red", "green", "blue", "alpha", and "value" (luma by ITU-R BT.709), from 0 to 1.
program::SourceField make_texture(size_t columns, size_t rows, const std::vector<uint8_t>& rgba, const Hash& content,
                                  const TextureUse& use);

}  // namespace ombre::nodes

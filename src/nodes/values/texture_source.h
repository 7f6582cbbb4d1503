// Images as field sources.
#pragma once

#include <cstdint>
#include <vector>

#include "program/field_source.h"

namespace ombre::nodes {

struct TextureUse {
  bool repeats = true;     // if false, pixels at the border are continued outside the image
  bool is_linear = false;  // values are converted to linear light; if false, they stay in sRGB
};

// Makes a source from `rgba`, which has rows from the top with four bytes per pixel in sRGB. The source's space is in
// pixels: x and y are counted from the lower left corner, so that the first pixel's centre is at 0.5. Values are
// interpolated linearly between centres. The channels "red", "green", "blue", "alpha" and "value" (luma by ITU-R
// BT.709) range from 0 to 1.
program::SourceField make_texture(size_t columns, size_t rows, const std::vector<uint8_t>& rgba, const Hash& content,
                                  const TextureUse& use);

}  // namespace ombre::nodes

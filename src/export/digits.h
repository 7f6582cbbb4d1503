// A tiny font for labels: digits and a few signs, five pixels high.
#pragma once

#include <cstdint>
#include <string_view>

#include "export/picture_file.h"

namespace ombre::exporting {

// Returns the width in pixels at `scale`; characters missing from the font are blank.
uint32_t text_width(std::string_view text, uint32_t scale);
uint32_t text_height(uint32_t scale);
// Draws a text with its top left corner at (column, row); parts outside the picture are clipped.
void draw_text(Picture& picture, uint32_t column, uint32_t row, std::string_view text, uint32_t scale,
               formats::Rgba colour);

}  // namespace ombre::exporting

// A tiny font for labels: digits and a few signs, five pixels high.
#pragma once

#include <cstdint>
#include <string_view>

#include "export/picture_file.h"

namespace ombre::exporting {

// Width in pixels at `scale`; what the font lacks is a gap.
uint32_t text_width(std::string_view text, uint32_t scale);
uint32_t text_height(uint32_t scale);
// With its top left corner at (column, row); what lies outside the picture is cut off.
void draw_text(Picture& picture, uint32_t column, uint32_t row, std::string_view text, uint32_t scale,
               formats::Rgba colour);

}  // namespace ombre::exporting

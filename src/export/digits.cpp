// A tiny font for labels: digits and a few signs, five pixels high.
#include "export/digits.h"

#include <array>

namespace ombre::exporting {
namespace {

constexpr uint32_t glyph_height = 5;

struct Glyph {
  char sign;
  std::array<std::string_view, glyph_height> rows;
};

constexpr std::array<Glyph, 13> glyphs{{
    {'0', {"###", "# #", "# #", "# #", "###"}},
    {'1', {" # ", "## ", " # ", " # ", "###"}},
    {'2', {"###", "  #", "###", "#  ", "###"}},
    {'3', {"###", "  #", "###", "  #", "###"}},
    {'4', {"# #", "# #", "###", "  #", "  #"}},
    {'5', {"###", "#  ", "###", "  #", "###"}},
    {'6', {"###", "#  ", "###", "# #", "###"}},
    {'7', {"###", "  #", "  #", "  #", "  #"}},
    {'8', {"###", "# #", "###", "# #", "###"}},
    {'9', {"###", "# #", "###", "  #", "###"}},
    {'.', {" ", " ", " ", " ", "#"}},
    {'-', {"   ", "   ", "###", "   ", "   "}},
    {'m', {"     ", "     ", "#### ", "# # #", "# # #"}},
}};

constexpr Glyph gap{' ', {"  ", "  ", "  ", "  ", "  "}};

const Glyph& glyph(char sign) {
  for (const Glyph& g : glyphs)
    if (g.sign == sign) return g;
  return gap;
}

}  // namespace

uint32_t text_width(std::string_view text, uint32_t scale) {
  uint32_t width = 0;
  for (const char sign : text) width += (static_cast<uint32_t>(glyph(sign).rows[0].size()) + 1) * scale;
  return width;
}

uint32_t text_height(uint32_t scale) { return glyph_height * scale; }

void draw_text(Picture& picture, uint32_t column, uint32_t row, std::string_view text, uint32_t scale,
               formats::Rgba colour) {
  for (const char sign : text) {
    const Glyph& g = glyph(sign);
    for (uint32_t y = 0; y < glyph_height * scale; ++y)
      for (uint32_t x = 0; x < g.rows[0].size() * scale; ++x)
        if (g.rows[y / scale][x / scale] == '#') picture.set(column + x, row + y, colour);
    column += (static_cast<uint32_t>(g.rows[0].size()) + 1) * scale;
  }
}

}  // namespace ombre::exporting

// Texts as regions of the plane.
#pragma once

#include <optional>

#include "base/text/diagnostic.h"
#include "draw/text_outlines.h"
#include "solids/solid.h"

namespace ombre::solids {

// Returns the region of a text. `size` is about the height of capital letters: the em is size * 100 / 72. A font is
// named as in OpenSCAD, "Liberation Sans:style=Bold", or is the path of a file.
Region region_of_text(const Text& text, const SourceRange& where, Diagnostics& messages);
// Returns the measures of the same text. If there is no font, adds an error and returns nothing.
std::optional<draw::RunMeasures> measures_of(const Text& text, const SourceRange& where, Diagnostics& messages);
// Returns the measures in mm of the font in which the text would be written.
std::optional<draw::FontMeasures> font_measures_of(const Text& text, const SourceRange& where, Diagnostics& messages);

}  // namespace ombre::solids

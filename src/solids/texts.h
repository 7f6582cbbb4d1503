// Texts as regions of the plane.
#pragma once

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

// Returns the region of a text. `size` is about the height of capital letters: the em is size * 100 / 72. A font is
// named as in OpenSCAD, "Liberation Sans:style=Bold", or is the path of a file.
Region region_of_text(const Text& text, const SourceRange& where, Diagnostics& messages);

}  // namespace ombre::solids

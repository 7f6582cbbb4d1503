// Reads the outlines in SVG path data.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/math/polygons.h"

namespace ombre::formats {

struct SvgPath {
  std::vector<Ring> rings;      // in the path's own units
  std::vector<bool> is_closed;  // by ring: it ends with the command Z
  std::string error;            // the error, if there is one; the rings before it are valid
};

SvgPath read_svg_path(std::string_view data, int chords_per_turn);

// Reads at most `most` numbers separated by blanks and commas, and removes them from the text.
std::vector<double> read_svg_numbers(std::string_view& text, size_t most);

}  // namespace ombre::formats

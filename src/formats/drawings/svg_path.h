// The outlines that the path data of SVG describe.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/math/polygons.h"

namespace ombre::formats {

struct SvgPath {
  std::vector<Ring> rings;  // in the path's own units, closed or not
  std::string error;        // what is wrong, if something is: the rings so far stand
};

SvgPath read_svg_path(std::string_view data, int chords_per_turn);

// Numbers between blanks and commas, until something else comes.
std::vector<double> read_svg_numbers(std::string_view& text, size_t most);

}  // namespace ombre::formats

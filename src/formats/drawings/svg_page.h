// Lengths and viewports of SVG.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/math/vec.h"
#include "formats/drawings/plane_map.h"

namespace ombre::formats {

// A number with its unit: "mm", "%", or empty.
struct SvgLength {
  double number = 0;
  std::string_view unit;
};

// Returns a length, or null if the text does not begin with a number.
std::optional<SvgLength> read_svg_length(std::string_view text);
// Returns the millimetres of an absolute unit other than px, or null.
std::optional<double> millimetres_of_unit(std::string_view unit);

// The rectangle of a viewBox: the corner and the sizes.
struct SvgBox {
  Vec2 corner, size;
};

// Returns the box of a text of four numbers with sizes above 0, or null.
std::optional<SvgBox> read_svg_box(std::string_view text);

// Returns the map that fits a box into a viewport, by the text of preserveAspectRatio (SVG 1.1, section 7.8); null if
// that is invalid.
std::optional<PlaneMap> fit_svg_box(const SvgBox& box, const SvgBox& viewport, std::string_view aspect);

// Returns the map of a list of transforms such as "translate(3, 4) scale(2)"; null if it is none. `wrong` is the name
// of the invalid function, or empty.
std::optional<PlaneMap> read_svg_transform(std::string_view text, std::string& wrong);

}  // namespace ombre::formats

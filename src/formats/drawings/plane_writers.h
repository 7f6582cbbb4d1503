// Writes regions of the plane as SVG and DXF drawings. Equal drawings give equal bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/polygons.h"
#include "formats/images/rgba.h"

namespace ombre::formats {

struct DrawnRegion {
  std::string part;            // class in SVG, layer in DXF; may be empty
  std::optional<Rgba> colour;  // light gray in SVG if not set
  std::vector<Ring> rings;     // mm, y up; a point is inside if an odd number of rings encloses it
};

// Returns an SVG drawing with one unit per millimetre; a point (x, y) is written as x, -y.
std::string drawing_svg(const std::string& title, const std::vector<DrawnRegion>& regions);
// Returns a DXF drawing of closed polylines, in text form.
std::string drawing_dxf(const std::vector<DrawnRegion>& regions);

}  // namespace ombre::formats

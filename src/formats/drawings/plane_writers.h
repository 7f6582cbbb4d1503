// Drawings as files: SVG and DXF of regions of the plane. Equal drawings give equal bytes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/polygons.h"
#include "formats/images/rgba.h"

namespace ombre::formats {

struct DrawnRegion {
  std::string part;            // its class in SVG, its layer in DXF; may be empty
  std::optional<Rgba> colour;  // else light gray in SVG
  std::vector<Ring> rings;     // inside is what an odd number goes round; mm, y up
};

// One unit a millimetre; a point (x, y) is written as x, -y.
std::string drawing_svg(const std::string& title, const std::vector<DrawnRegion>& regions);
// Closed polylines, in text form.
std::string drawing_dxf(const std::vector<DrawnRegion>& regions);

}  // namespace ombre::formats

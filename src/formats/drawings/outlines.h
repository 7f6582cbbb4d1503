// Closed polygons of a layer's regions, for files of outlines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "formats/images/rgba.h"

namespace ombre::formats {

struct OutlinedRegion {
  std::string name;
  Rgba colour{128, 128, 128, 255};
};

struct OutlineDocument {
  std::string title;
  Box box;  // bounds of all layers in mm
  std::vector<OutlinedRegion> regions;
};

// The polygons of each region in mm: counter-clockwise, or clockwise around holes, without a repeated first point.
using OutlinePolygons = std::vector<std::vector<std::vector<Vec2>>>;

}  // namespace ombre::formats

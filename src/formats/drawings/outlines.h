// Closed polygons of a layer's regions, as files of outlines take them.
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
  Box box;  // around all layers, mm
  std::vector<OutlinedRegion> regions;
};

// For each region its polygons: counter-clockwise, or clockwise around holes, without the first point at the end; mm.
using OutlinePolygons = std::vector<std::vector<std::vector<Vec2>>>;

}  // namespace ombre::formats

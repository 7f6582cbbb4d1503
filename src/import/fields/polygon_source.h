// Polygons as field sources.
#pragma once

#include <string>

#include "base/math/polygons.h"
#include "program/field_source.h"

namespace ombre::importing {

struct PolygonOptions {
  // True for a solid of revolution about the line x = 0; edges on that line are not walls of its inside.
  bool turns_about_y = false;
};

// Returns the source of polygons. Its channels, at (x, y, any z):
//   "inside"    1 inside, 0 outside. Its rows are exact.
//   "distance"  signed distance in mm to the nearest wall, negative inside. Overlaps of polygons and edges that cross
//               leave no walls inside.
program::SourceField make_polygon_source(std::string name, Polygons polygons, PolygonOptions options = {});

}  // namespace ombre::importing

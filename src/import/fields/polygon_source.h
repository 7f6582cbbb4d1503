// Polygons as field sources.
#pragma once

#include <string>

#include "base/math/polygons.h"
#include "program/field_source.h"

namespace ombre::importing {

struct PolygonOptions {
  // The solid turns about the line x = 0: edges on it are no walls to what is inside.
  bool turns_about_y = false;
};

// Channels, at (x, y, any z):
//   "inside"    1 inside, 0 outside. Its rows are exact.
//   "distance"  mm to the nearest wall, negative inside. What polygons have in common, and edges that cross, leave no
//               walls inside.
program::SourceField make_polygon_source(std::string name, Polygons polygons, PolygonOptions options = {});

}  // namespace ombre::importing

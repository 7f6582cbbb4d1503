// Drawings in files: the closed outlines that SVG and DXF files hold.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/polygons.h"
#include "base/text/diagnostic.h"

namespace ombre::formats {

struct PlaneOptions {
  std::string layer, id;      // only what is on the layer (DXF), or in the element (SVG); empty: all
  double dots_per_inch = 72;  // of SVG lengths without a unit
  int chords_per_turn = 40;   // of circles and arcs
  // Chords of circles and arcs by their radius, in units of the drawing (DXF); empty: the same for all.
  std::function<int(double radius)> chords_of_radius = {};
};

// Inside of a shape is what an odd number of its rings goes round.
struct PlaneShapes {
  std::vector<std::vector<Ring>> shapes;  // mm, y up
};

// What rect, circle, ellipse, polygon, polyline and path enclose; transforms, groups, viewBox. The picture's lower edge
// is y = 0. As in OpenSCAD 2021.01, lengths are mm where there is no viewBox, and a viewBox that begins at another y
// than 0 moves the picture down by that. Lines and strokes have no area and are left out with a warning. Nothing, and
// diagnostics, for what is no SVG.
std::optional<PlaneShapes> read_svg(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics);

// LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE (with bulges), POLYLINE, and INSERT of blocks; lines whose ends meet become
// rings of one shape, and where the ends of a chain do not meet, a straight line joins them, with a warning. Nothing,
// and diagnostics, for what is no DXF.
std::optional<PlaneShapes> read_dxf(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics);

}  // namespace ombre::formats

// Reads drawings: the closed outlines in SVG and DXF files.
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
  std::string layer, id;      // restrict reading to a layer (DXF) or an element (SVG); empty for all
  double dots_per_inch = 72;  // for SVG lengths without a unit
  int chords_per_turn = 40;   // for circles and arcs
  // Number of chords of a circle or arc by its radius in units of the drawing (DXF); if empty, chords_per_turn is used.
  std::function<int(double radius)> chords_of_radius = {};
};

// The shapes of a drawing. A point is inside of a shape if an odd number of its rings encloses it.
struct PlaneShapes {
  std::vector<std::vector<Ring>> shapes;  // mm, y up
};

// Reads rect, circle, ellipse, polygon, polyline and path elements, with transforms, groups and viewBox. The lower edge
// of the picture is y = 0. As in OpenSCAD 2021.01, lengths are mm if there is no viewBox, and a viewBox with y other
// than 0 moves the picture down by that. Lines and strokes have no area and are left out with a warning. Null, with
// diagnostics, if the bytes are not SVG.
std::optional<PlaneShapes> read_svg(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics);

// Reads LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE (with bulges), POLYLINE, and INSERT of blocks. Lines whose ends meet
// become rings of one shape; a chain whose ends do not meet is closed by a straight line, with a warning. Null, with
// diagnostics, if the bytes are not DXF.
std::optional<PlaneShapes> read_dxf(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics);

}  // namespace ombre::formats

// Reads drawings: the areas in SVG and DXF files.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/polygons.h"
#include "base/text/diagnostic.h"
#include "formats/drawings/plane_map.h"

namespace ombre::formats {

struct PlaneOptions {
  std::string layer, id;      // restrict reading to a layer (DXF) or an element (SVG); empty for all
  double dots_per_inch = 72;  // for SVG lengths without a unit
  int chords_per_turn = 40;   // for circles and arcs
  // Number of chords of a circle or arc by its radius in units of the drawing (DXF); if empty, chords_per_turn is used.
  std::function<int(double radius)> chords_of_radius = {};
  // Reads SVG as it is painted: an outline without a fill encloses nothing, and each stroke is an area.
  bool is_painted = false;
};

enum class StrokeCap : uint8_t { butt, round, square };
enum class StrokeJoin : uint8_t { miter, round, bevel };

// Lines with a width, in coordinates of their own; `map` takes them to mm.
struct PlaneStroke {
  std::vector<Ring> open, closed;
  double width = 1, miter_limit = 4;
  StrokeCap cap = StrokeCap::butt;
  StrokeJoin join = StrokeJoin::miter;
  PlaneMap map;
};

struct PlaneShape;
// The union of its shapes, to which another shape is cut.
using PlaneClip = std::shared_ptr<const std::vector<PlaneShape>>;

struct PlaneShape {
  std::vector<Ring> rings;  // mm, y up
  bool is_nonzero = false;  // points with a winding number other than 0 are inside, else those with an odd number
  std::optional<PlaneStroke> stroke;
  std::vector<PlaneClip> clips;  // the shape is cut to each of them
};

// The shapes of a drawing, whose union is its area.
struct PlaneShapes {
  std::vector<PlaneShape> shapes;
  std::map<std::string, size_t> left_out;  // how many things of each kind are no areas: "texts", "open lines"
};

// Returns a list such as "2 texts, 1 images".
std::string text_of_left_out(const std::map<std::string, size_t>& left_out);

// Reads the shapes of SVG with their transforms, style sheets, viewports, uses and clip paths. The lower edge of the
// picture is y = 0. As in OpenSCAD 2021.01, lengths are mm if there is no viewBox, and a viewBox with y other than 0
// moves the picture down by that. A closed outline is an area even without a fill. The area of open lines without a
// fill is that of their stroke. Null, with diagnostics, if the bytes are not SVG, or use what is not read and changes
// shapes.
std::optional<PlaneShapes> read_svg(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics);

// Reads LINE, ARC, CIRCLE, ELLIPSE, SPLINE, LWPOLYLINE (with bulges), POLYLINE, and INSERT of blocks in model space.
// Lines whose ends lie within a tolerance become rings of one shape; a chain whose ends do not meet is closed by a
// straight line, with a note. HATCH, SOLID and TRACE are areas where no ring encloses them. Null, with diagnostics, if
// the bytes are not DXF in text form.
std::optional<PlaneShapes> read_dxf(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics);

}  // namespace ombre::formats

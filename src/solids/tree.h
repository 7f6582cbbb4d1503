// Trees of polyhedral geometry as described by OpenSCAD scripts, before evaluation. Millimetres and degrees.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/math/vec.h"
#include "base/text/source_text.h"

namespace ombre::solids {

// Nodes with a `convexity` store it for .csg files, where OpenSCAD's preview uses it. Geometry does not depend on it.

// Parameters for the number of edges of circles: OpenSCAD's $fn, $fa (degrees) and $fs (mm).
struct Fragments {
  double count = 0, angle = 12, size = 2;
  bool operator==(const Fragments&) const = default;
};

// Red, green, blue and opacity, each from 0 to 1.
using Colour = std::array<double, 4>;

// Leaves that are solids:
struct Cube {
  Vec3 size{1, 1, 1};
  bool centred = false;
};
struct Sphere {
  double radius = 1;
  Fragments fragments = {};
};
struct Cylinder {
  double height = 1, bottom_radius = 1, top_radius = 1;
  bool centred = false;
  Fragments fragments = {};
};
// A list of which an element is no point. Its solid is left out with a warning.
struct WrongPoints {
  std::string message, written;  // `written`: the list as the script has it
};

struct Polyhedron {
  std::vector<Vec3> points;
  std::vector<std::vector<size_t>> faces;  // clockwise when seen from outside, as in OpenSCAD
  int convexity = 1;
  std::optional<WrongPoints> wrong = {};
};

// Leaves that are regions in the plane z = 0:
struct Square {
  Vec2 size{1, 1};
  bool centred = false;
};
struct Circle {
  double radius = 1;
  Fragments fragments = {};
};
struct Polygon {
  std::vector<Vec2> points;
  std::vector<std::vector<size_t>> paths;  // empty: one path of all points
  int convexity = 1;
  std::optional<WrongPoints> wrong = {};
};
struct Text {
  std::string text;
  double size = 10;
  std::string font, horizontal = "left", vertical = "baseline", direction = "ltr", language = "en", script = "Latn";
  double spacing = 1;
  Fragments fragments = {};
  std::vector<std::string> font_files = {};  // files of fonts that come before those of the system
};

// Leaves that are files, with absolute paths:
struct Import {
  std::string path;
  std::string layer, id;  // for DXF and SVG files
  Vec2 origin = {};
  double scale = 1, dots_per_inch = 72;
  bool centred = false;
  bool is_painted = false;  // an SVG file is read as it is painted: strokes are areas, outlines without a fill are none
  int convexity = 1;
  Fragments fragments = {};
};
struct Surface {  // heights from a .dat or PNG file
  std::string path;
  bool centred = false, inverted = false;
};

// Operations on children. A group keeps solids with different attributes apart ("soft union").
struct Group {};
struct Union {
  std::optional<int> render;  // the convexity of render(), which is a union
};
struct Difference {};
struct Intersection {};
struct Hull {};
struct Minkowski {
  int convexity = 0;
};
struct Fill {};
struct Transform {
  Affine parent_from_child;
};
struct Resize {
  Vec3 size;  // 0: unchanged, or in proportion if automatic
  std::array<bool, 3> automatic{};
  int convexity = 0;
};
struct Offset {
  double distance = 0;  // mm outward
  bool round = false;   // otherwise edges are straight, and cut if `chamfer` is set
  bool chamfer = false;
  Fragments fragments = {};
};
struct LinearExtrude {
  double height = 100, twist = 0;  // mm, degrees
  Vec3 direction{0, 0, 1};
  Vec2 scale{1, 1};
  bool centred = false;
  std::optional<int> slices = {}, segments = {};
  int convexity = 1;
  Fragments fragments = {};
};
struct RotateExtrude {
  double angle = 360;                // degrees
  std::optional<double> start = {};  // degrees from the x axis; by default 180 for a whole turn, else 0
  int convexity = 2;
  Fragments fragments = {};
};
enum class RoofMethod : uint8_t {
  distance,  // the height of a point is its distance from the outline: cones rise from inward corners
  straight,  // planes rise from the sides alone
};
struct Roof {
  RoofMethod method = RoofMethod::distance;
  int convexity = 1;
  Fragments fragments = {};
};
struct Projection {
  bool cut = false;
  int convexity = 0;
};

// Attributes of all geometry below; the outermost of each kind counts.
// a negative component is not set: color("red", 0.5) sets all four, color(alpha = 0.5) only the opacity
struct SetColour {
  Colour colour{1, 1, 1, 1};
};
struct SetPart {
  std::string name;
};
struct SetMaterial {
  std::string name;
};

// A solid that a function of another vocabulary makes of the children. It is not a polyhedron; the reader that knows
// the vocabulary interprets it.
struct Word {
  std::string name, arguments;  // as .csg files write them
  std::shared_ptr<const void> solid;
};

using Operation =
    std::variant<Group, Cube, Sphere, Cylinder, Polyhedron, Square, Circle, Polygon, Text, Import, Surface, Union,
                 Difference, Intersection, Hull, Minkowski, Fill, Transform, Resize, Offset, LinearExtrude,
                 RotateExtrude, Roof, Projection, SetColour, SetPart, SetMaterial, Word>;

// The rule for solids of different parts or materials in an operation.
enum class Semantics : uint8_t { standard, strict, permissive };

struct Tree;
using TreePtr = std::shared_ptr<const Tree>;

struct Tree {
  Operation operation;
  std::vector<TreePtr> children;
  bool background = false;  // the modifier %: shown in previews only
  bool highlight = false;   // the modifier #
  Semantics semantics = Semantics::standard;
  SourceRange where;  // place of the call, for messages
};

}  // namespace ombre::solids

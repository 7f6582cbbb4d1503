#include "lang/openscad/csg_text.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {
namespace {

using solids::Tree;

std::string fragments_text(const solids::Fragments& fragments) {
  return "$fn = " + stream_text(fragments.count) + ", $fa = " + stream_text(fragments.angle) +
         ", $fs = " + stream_text(fragments.size);
}

const char* truth_text(bool value) { return value ? "true" : "false"; }
std::string quoted(const std::string& text) { return '"' + text + '"'; }

template <class Sequence>
std::string vector_text(const Sequence& numbers, const char* separator = ", ") {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : separator) + stream_text(number);
  return '[' + text + ']';
}

std::string vector_text(Vec3 v, const char* separator = ", ") {
  return vector_text(std::array<double, 3>{v.x, v.y, v.z}, separator);
}
std::string vector_text(Vec2 v) { return vector_text(std::array<double, 2>{v.x, v.y}); }

template <class List, class Write>
std::string list_text(const List& list, const Write& write) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + write(item);
  return '[' + text + ']';
}

std::string indices_text(const std::vector<std::vector<size_t>>& lists) {
  return list_text(lists, [](const std::vector<size_t>& indices) {
    return list_text(indices, [](size_t index) { return number_text(static_cast<double>(index)); });
  });
}

std::string point_text(Vec3 p) {
  return '[' + number_text(p.x) + ", " + number_text(p.y) + ", " + number_text(p.z) + ']';
}
std::string point_text(Vec2 p) { return '[' + number_text(p.x) + ", " + number_text(p.y) + ']'; }

// A text without letters has no script.
bool has_letters(const std::string& text) {
  return std::ranges::any_of(text, [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
}

// ISO 15924 writes "Latn".
std::string script_tag(std::string tag) {
  for (size_t i = 0; i < tag.size(); ++i) {
    if (i == 0 && tag[i] >= 'a' && tag[i] <= 'z') tag[i] = static_cast<char>(tag[i] - 'a' + 'A');
    if (i > 0 && tag[i] >= 'A' && tag[i] <= 'Z') tag[i] = static_cast<char>(tag[i] - 'A' + 'a');
  }
  return tag;
}

// The name of an operation and its arguments: "cube(size = [1, 1, 1], center = false)".
class Head {
 public:
  explicit Head(const std::string& folder) : folder_(folder) {}

  std::string operator()(const solids::Group&) const { return "group()"; }
  std::string operator()(const solids::Cube& cube) const {
    return "cube(size = " + vector_text(cube.size) + ", center = " + truth_text(cube.centred) + ')';
  }
  std::string operator()(const solids::Sphere& sphere) const {
    return "sphere(" + fragments_text(sphere.fragments) + ", r = " + stream_text(sphere.radius) + ')';
  }
  std::string operator()(const solids::Cylinder& cylinder) const {
    return "cylinder(" + fragments_text(cylinder.fragments) + ", h = " + stream_text(cylinder.height) +
           ", r1 = " + stream_text(cylinder.bottom_radius) + ", r2 = " + stream_text(cylinder.top_radius) +
           ", center = " + truth_text(cylinder.centred) + ')';
  }
  std::string operator()(const solids::Polyhedron& solid) const {
    return "polyhedron(points = " + list_text(solid.points, [](Vec3 p) { return point_text(p); }) +
           ", faces = " + indices_text(solid.faces) + ", convexity = " + std::to_string(solid.convexity) + ')';
  }
  std::string operator()(const solids::Square& square) const {
    return "square(size = " + vector_text(square.size) + ", center = " + truth_text(square.centred) + ')';
  }
  std::string operator()(const solids::Circle& circle) const {
    return "circle(" + fragments_text(circle.fragments) + ", r = " + stream_text(circle.radius) + ')';
  }
  std::string operator()(const solids::Polygon& polygon) const {
    const auto points = list_text(polygon.points, [](Vec2 p) { return point_text(p); });
    return "polygon(points = " + (polygon.points.empty() ? "undef" : points) +
           ", paths = " + (polygon.paths.empty() ? "undef" : indices_text(polygon.paths)) +
           ", convexity = " + std::to_string(polygon.convexity) + ')';
  }
  std::string operator()(const solids::Text& text) const {
    const std::string script = has_letters(text.text) ? ", script = " + quoted(script_tag(text.script)) : "";
    return "text(text = " + quoted(text.text) + ", size = " + stream_text(text.size) +
           ", spacing = " + stream_text(text.spacing) + ", font = " + quoted(text.font) +
           ", direction = " + quoted(text.direction) + ", language = " + quoted(text.language) + script +
           ", halign = " + quoted(text.horizontal) + ", valign = " + quoted(text.vertical) + ", " +
           fragments_text(text.fragments) + ')';
  }
  std::string operator()(const solids::Import& file) const {
    const bool has_dots = file.path.ends_with(".svg");
    const std::string placed =
        has_dots ? std::string(", center = ") + truth_text(file.centred) + ", dpi = " + stream_text(file.dots_per_inch)
                 : "";
    return "import(file = " + quoted(path(file.path)) + ", layer = " + quoted(file.layer) +
           ", origin = " + vector_text(file.origin) + placed + ", scale = " + stream_text(file.scale) +
           ", convexity = " + std::to_string(file.convexity) + ", " + fragments_text(file.fragments) +
           ", timestamp = 0)";
  }
  std::string operator()(const solids::Surface& surface) const {
    return "surface(file = " + quoted(path(surface.path)) + ", center = " + truth_text(surface.centred) +
           ", invert = " + truth_text(surface.inverted) + ", timestamp = 0)";
  }
  std::string operator()(const solids::Union& all) const {
    return all.render ? "render(convexity = " + std::to_string(*all.render) + ')' : "union()";
  }
  std::string operator()(const solids::Difference&) const { return "difference()"; }
  std::string operator()(const solids::Intersection&) const { return "intersection()"; }
  std::string operator()(const solids::Hull&) const { return "hull()"; }
  std::string operator()(const solids::Minkowski& sum) const {
    return "minkowski(convexity = " + std::to_string(sum.convexity) + ')';
  }
  std::string operator()(const solids::Fill&) const { return "fill()"; }
  std::string operator()(const solids::Transform& transform) const {
    const Affine& map = transform.parent_from_child;
    std::string rows;
    for (int row = 0; row < 3; ++row) {
      const Vec3 r = map.rows[static_cast<size_t>(row)];
      rows += list_text(std::array<double, 4>{r.x, r.y, r.z, map.offset[row]}, number_text) + ", ";
    }
    return "multmatrix([" + rows + "[0, 0, 0, 1]])";
  }
  std::string operator()(const solids::Resize& resize) const {
    std::array<double, 3> automatic{};
    for (size_t axis = 0; axis < 3; ++axis) automatic[axis] = resize.automatic[axis] ? 1 : 0;
    return "resize(newsize = " + vector_text(resize.size, ",") + ", auto = " + vector_text(automatic, ",") +
           ", convexity = " + std::to_string(resize.convexity) + ')';
  }
  std::string operator()(const solids::Offset& offset) const {
    const std::string how =
        offset.round ? "r = " + stream_text(offset.distance)
                     : "delta = " + stream_text(offset.distance) + ", chamfer = " + truth_text(offset.chamfer);
    return "offset(" + how + ", " + fragments_text(offset.fragments) + ')';
  }
  std::string operator()(const solids::LinearExtrude& extrude) const {
    const Vec3 v = extrude.direction;
    const bool is_upright = v.x == 0 && v.y == 0;
    std::string text = "linear_extrude(height = " + stream_text(extrude.height) +
                       (is_upright ? "" : ", v = " + vector_text(v)) + ", center = " + truth_text(extrude.centred) +
                       ", convexity = " + std::to_string(extrude.convexity);
    const bool has_slices = extrude.slices.has_value();
    if (extrude.twist != 0) text += ", twist = " + stream_text(extrude.twist);
    if (has_slices) text += ", slices = " + std::to_string(*extrude.slices);
    text += ", scale = " + vector_text(extrude.scale);
    return text + (has_slices ? "" : ", " + fragments_text(extrude.fragments)) + ')';
  }
  std::string operator()(const solids::RotateExtrude& extrude) const {
    const std::string start = extrude.start == 0 ? "" : ", start = " + stream_text(extrude.start);
    return "rotate_extrude(angle = " + stream_text(extrude.angle) + start +
           ", convexity = " + std::to_string(extrude.convexity) + ", " + fragments_text(extrude.fragments) + ')';
  }
  std::string operator()(const solids::Projection& projection) const {
    return std::string("projection(cut = ") + truth_text(projection.cut) +
           ", convexity = " + std::to_string(projection.convexity) + ')';
  }
  std::string operator()(const solids::SetColour& colour) const { return "color(" + vector_text(colour.colour) + ')'; }
  std::string operator()(const solids::SetPart& part) const { return "part(name = " + quoted(part.name) + ')'; }
  std::string operator()(const solids::SetMaterial& material) const {
    return "material(name = " + quoted(material.name) + ')';
  }

 private:
  std::string path(const std::string& complete) const {
    if (folder_.empty() || complete.empty()) return complete;
    const auto relative = std::filesystem::path(complete).lexically_relative(folder_);
    return relative.empty() ? complete : relative.generic_string();
  }

  const std::string& folder_;
};

class TreePrinter {
 public:
  explicit TreePrinter(const std::string& folder) : head_(folder) {}
  std::string text;

  void print(const Tree& tree, size_t depth) {
    if (tree.background) text += '%';
    if (tree.highlight) text += '#';
    text.append(depth, '\t');
    text += std::visit(head_, tree.operation);
    if (tree.children.empty()) {
      text += ";\n";
      return;
    }
    text += " {\n";
    for (const solids::TreePtr& child : tree.children) print(*child, depth + 1);
    text.append(depth, '\t');
    text += "}\n";
  }

 private:
  Head head_;
};

}  // namespace

std::string csg_text(const Tree& root, const std::string& folder) {
  TreePrinter printer(folder);
  const bool is_whole = std::holds_alternative<solids::Group>(root.operation) && !root.where.source;
  if (!is_whole) printer.print(root, 0);
  if (is_whole)
    for (const solids::TreePtr& child : root.children) printer.print(*child, 0);
  return std::move(printer.text);
}

}  // namespace ombre::lang::openscad

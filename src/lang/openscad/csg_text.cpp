#include "lang/openscad/csg_text.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {
namespace {

using solids::Tree;

const char* truth_text(bool value) { return value ? "true" : "false"; }

template <class List, class Write>
std::string list_text(const List& list, const Write& write) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + write(item);
  return '[' + text + ']';
}

std::string indices_text(const std::vector<std::vector<size_t>>& lists) {
  return list_text(lists, [](const std::vector<size_t>& indices) {
    return list_text(indices, [](size_t index) { return std::to_string(index); });
  });
}

// True if the text has letters, and therefore a script.
bool has_letters(const std::string& text) {
  return std::ranges::any_of(text, [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); });
}

// Capitalises the tag as ISO 15924 does: "Latn".
std::string script_tag(std::string tag) {
  for (size_t i = 0; i < tag.size(); ++i) {
    if (i == 0 && tag[i] >= 'a' && tag[i] <= 'z') tag[i] = static_cast<char>(tag[i] - 'a' + 'A');
    if (i > 0 && tag[i] >= 'A' && tag[i] <= 'Z') tag[i] = static_cast<char>(tag[i] - 'A' + 'a');
  }
  return tag;
}

// Writes the name of an operation and its arguments: "cube(size = [1, 1, 1], center = false)".
class Head {
 public:
  Head(const std::string& folder, CsgForm form) : folder_(folder), is_exact_(form == CsgForm::exact) {}

  std::string operator()(const solids::Group&) const { return "group()"; }
  std::string operator()(const solids::Cube& cube) const {
    return "cube(size = " + vector(cube.size) + ", center = " + truth_text(cube.centred) + ')';
  }
  std::string operator()(const solids::Sphere& sphere) const {
    return "sphere(" + fragments(sphere.fragments) + ", r = " + stream(sphere.radius) + ')';
  }
  std::string operator()(const solids::Cylinder& cylinder) const {
    return "cylinder(" + fragments(cylinder.fragments) + ", h = " + stream(cylinder.height) +
           ", r1 = " + stream(cylinder.bottom_radius) + ", r2 = " + stream(cylinder.top_radius) +
           ", center = " + truth_text(cylinder.centred) + ')';
  }
  std::string operator()(const solids::Polyhedron& solid) const {
    return "polyhedron(points = " +
           (solid.wrong ? solid.wrong->written : list_text(solid.points, [this](Vec3 p) { return point(p); })) +
           ", faces = " + indices_text(solid.faces) + ", convexity = " + std::to_string(solid.convexity) + ')';
  }
  std::string operator()(const solids::Square& square) const {
    return "square(size = " + vector(square.size) + ", center = " + truth_text(square.centred) + ')';
  }
  std::string operator()(const solids::Circle& circle) const {
    return "circle(" + fragments(circle.fragments) + ", r = " + stream(circle.radius) + ')';
  }
  std::string operator()(const solids::Polygon& polygon) const {
    const auto points =
        polygon.wrong ? polygon.wrong->written : list_text(polygon.points, [this](Vec2 p) { return point(p); });
    return "polygon(points = " + (polygon.points.empty() ? "undef" : points) +
           ", paths = " + (polygon.paths.empty() ? "undef" : indices_text(polygon.paths)) +
           ", convexity = " + std::to_string(polygon.convexity) + ')';
  }
  std::string operator()(const solids::Text& text) const {
    const std::string script = has_letters(text.text) ? ", script = " + quoted(script_tag(text.script)) : "";
    return "text(text = " + quoted(text.text) + ", size = " + stream(text.size) +
           ", spacing = " + stream(text.spacing) + ", font = " + quoted(text.font) +
           ", direction = " + quoted(text.direction) + ", language = " + quoted(text.language) + script +
           ", halign = " + quoted(text.horizontal) + ", valign = " + quoted(text.vertical) + ", " +
           fragments(text.fragments) + ')';
  }
  std::string operator()(const solids::Import& file) const {
    const bool has_dots = is_exact_ || file.path.ends_with(".svg");
    const std::string placed =
        has_dots ? std::string(", center = ") + truth_text(file.centred) + ", dpi = " + stream(file.dots_per_inch) : "";
    return "import(file = " + quoted(path(file.path)) + ", layer = " + quoted(file.layer) +
           (is_exact_ ? ", id = " + quoted(file.id) : "") + ", origin = " + vector(file.origin) + placed +
           (is_exact_ && file.is_painted ? ", strokes = true" : "") + ", scale = " + stream(file.scale) +
           ", convexity = " + std::to_string(file.convexity) + ", " + fragments(file.fragments) + ", timestamp = 0)";
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
      rows += list_text(std::array<double, 4>{r.x, r.y, r.z, map.offset[row]},
                        [this](double entry) { return number(entry); }) +
              ", ";
    }
    return "multmatrix([" + rows + "[0, 0, 0, 1]])";
  }
  std::string operator()(const solids::Resize& resize) const {
    std::array<double, 3> automatic{};
    for (size_t axis = 0; axis < 3; ++axis) automatic[axis] = resize.automatic[axis] ? 1 : 0;
    return "resize(newsize = " + vector(resize.size, ",") + ", auto = " + vector(automatic, ",") +
           ", convexity = " + std::to_string(resize.convexity) + ')';
  }
  std::string operator()(const solids::Offset& offset) const {
    const std::string how = offset.round
                                ? "r = " + stream(offset.distance)
                                : "delta = " + stream(offset.distance) + ", chamfer = " + truth_text(offset.chamfer);
    return "offset(" + how + ", " + fragments(offset.fragments) + ')';
  }
  std::string operator()(const solids::LinearExtrude& extrude) const {
    const Vec3 v = extrude.direction;
    const bool is_upright = v.x == 0 && v.y == 0 && (!is_exact_ || v.z > 0);
    std::string text = "linear_extrude(height = " + stream(extrude.height) + (is_upright ? "" : ", v = " + vector(v)) +
                       ", center = " + truth_text(extrude.centred) +
                       ", convexity = " + std::to_string(extrude.convexity);
    const bool has_slices = extrude.slices.has_value();
    if (extrude.twist != 0) text += ", twist = " + stream(extrude.twist);
    if (has_slices) text += ", slices = " + std::to_string(*extrude.slices);
    if (is_exact_ && extrude.segments) text += ", segments = " + std::to_string(*extrude.segments);
    text += ", scale = " + vector(extrude.scale);
    return text + (has_slices && !is_exact_ ? "" : ", " + fragments(extrude.fragments)) + ')';
  }
  std::string operator()(const solids::RotateExtrude& extrude) const {
    const std::string start = extrude.start ? ", start = " + stream(*extrude.start) : "";
    return "rotate_extrude(angle = " + stream(extrude.angle) + start +
           ", convexity = " + std::to_string(extrude.convexity) + ", " + fragments(extrude.fragments) + ')';
  }
  std::string operator()(const solids::Roof& roof) const {
    return std::string("roof(method = \"") + (roof.method == solids::RoofMethod::straight ? "straight" : "voronoi") +
           "\", convexity = " + std::to_string(roof.convexity) + ", " + fragments(roof.fragments) + ')';
  }
  std::string operator()(const solids::Projection& projection) const {
    return std::string("projection(cut = ") + truth_text(projection.cut) +
           ", convexity = " + std::to_string(projection.convexity) + ')';
  }
  std::string operator()(const solids::SetColour& colour) const {
    // A negative channel means that only the opacity is set.
    if (is_exact_ && colour.colour[0] < 0) return "color(alpha = " + stream(colour.colour[3]) + ')';
    return "color(" + vector(colour.colour) + ')';
  }
  std::string operator()(const solids::SetPart& part) const { return "part(name = " + quoted(part.name) + ')'; }
  std::string operator()(const solids::SetMaterial& material) const {
    return "material(name = " + quoted(material.name) + ')';
  }
  std::string operator()(const solids::Word& word) const { return word.name + '(' + word.arguments + ')'; }

 private:
  std::string path(const std::string& complete) const {
    if (folder_.empty() || complete.empty()) return complete;
    const auto relative = std::filesystem::path(complete).lexically_relative(folder_);
    return relative.empty() ? complete : relative.generic_string();
  }

  std::string digits(double number, std::string (*six)(double)) const {
    return is_exact_ ? literal_of(number) : six(number);
  }
  std::string stream(double number) const { return digits(number, stream_text); }
  std::string number(double number) const { return digits(number, number_text); }
  // OpenSCAD writes texts without escaping quotes.
  std::string quoted(const std::string& text) const { return is_exact_ ? literal_of(text) : '"' + text + '"'; }

  template <class Sequence>
  std::string vector(const Sequence& numbers, const char* separator = ", ") const {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : separator) + stream(number);
    return '[' + text + ']';
  }
  std::string vector(Vec3 v, const char* separator = ", ") const {
    return vector(std::array<double, 3>{v.x, v.y, v.z}, separator);
  }
  std::string vector(Vec2 v) const { return vector(std::array<double, 2>{v.x, v.y}); }
  std::string point(Vec3 p) const { return '[' + number(p.x) + ", " + number(p.y) + ", " + number(p.z) + ']'; }
  std::string point(Vec2 p) const { return '[' + number(p.x) + ", " + number(p.y) + ']'; }
  std::string fragments(const solids::Fragments& circles) const {
    return "$fn = " + stream(circles.count) + ", $fa = " + stream(circles.angle) + ", $fs = " + stream(circles.size);
  }

  const std::string& folder_;
  bool is_exact_;
};

class TreePrinter {
 public:
  TreePrinter(const std::string& folder, CsgForm form) : head_(folder, form), is_exact_(form == CsgForm::exact) {}
  std::string text;

  void print(const Tree& tree, size_t depth) {
    if (tree.background) text += '%';
    if (tree.highlight) text += '#';
    text.append(depth, '\t');
    text += std::visit(head_, tree.operation);
    if (is_exact_) add_semantics(tree.semantics);
    has_words |= std::holds_alternative<solids::Word>(tree.operation);
    if (tree.children.empty()) {
      text += ";\n";
      return;
    }
    text += " {\n";
    for (const solids::TreePtr& child : tree.children) print(*child, depth + 1);
    text.append(depth, '\t');
    text += "}\n";
  }

  bool has_words = false;

 private:
  // Adds `semantics` as the last argument of the call that was just written.
  void add_semantics(solids::Semantics semantics) {
    if (semantics == solids::Semantics::standard) return;
    text.pop_back();
    text += text.ends_with('(') ? "" : ", ";
    text += semantics == solids::Semantics::strict ? "semantics = \"strict\")" : "semantics = \"permissive\")";
  }

  Head head_;
  bool is_exact_;
};

}  // namespace

std::string csg_text(const Tree& root, const std::string& folder, CsgForm form) {
  TreePrinter printer(folder, form);
  const bool is_whole = std::holds_alternative<solids::Group>(root.operation) && !root.where.source;
  if (!is_whole) printer.print(root, 0);
  if (is_whole)
    for (const solids::TreePtr& child : root.children) printer.print(*child, 0);
  return printer.has_words ? "use <ombre>\n" + printer.text : std::move(printer.text);
}

}  // namespace ombre::lang::openscad

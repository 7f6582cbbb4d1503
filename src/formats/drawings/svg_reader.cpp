// Reads SVG files.
#include "formats/drawings/plane_files.h"

#ifdef OMBRE_3MF

#include <cmath>

#include "formats/containers/text_scanner.h"
#include "formats/containers/xml_file.h"
#include "formats/drawings/arcs.h"
#include "formats/drawings/svg_path.h"

namespace ombre::formats {
namespace {

constexpr int deepest_element = 1000;  // greatest depth of nested elements

// The map x' = a x + c y + e, y' = b x + d y + f.
struct PlaneMap {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
};

PlaneMap operator*(const PlaneMap& m, const PlaneMap& n) {
  return {m.a * n.a + m.c * n.b, m.b * n.a + m.d * n.b,       m.a * n.c + m.c * n.d,
          m.b * n.c + m.d * n.d, m.a * n.e + m.c * n.f + m.e, m.b * n.e + m.d * n.f + m.f};
}

// Returns the map of a transform such as "translate(3, 4)", or null if it is invalid.
std::optional<PlaneMap> map_of(std::string_view name, const std::vector<double>& v) {
  const auto number = [&](size_t n, double otherwise) { return n < v.size() ? v[n] : otherwise; };
  if (name == "matrix" && v.size() == 6) return PlaneMap{v[0], v[1], v[2], v[3], v[4], v[5]};
  if (v.empty()) return std::nullopt;
  if (name == "translate") return PlaneMap{1, 0, 0, 1, v[0], number(1, 0)};
  if (name == "scale") return PlaneMap{v[0], 0, 0, number(1, v[0]), 0, 0};
  const double angle = v[0] * math::degree;
  if (name == "skewX") return PlaneMap{1, 0, std::tan(angle), 1, 0, 0};
  if (name == "skewY") return PlaneMap{1, std::tan(angle), 0, 1, 0, 0};
  if (name != "rotate") return std::nullopt;
  const double c = math::cos(angle), s = math::sin(angle), x = number(1, 0), y = number(2, 0);
  return PlaneMap{1, 0, 0, 1, x, y} * PlaneMap{c, s, -s, c, 0, 0} * PlaneMap{1, 0, 0, 1, -x, -y};
}

class SvgReader {
 public:
  SvgReader(const XmlFile& file, const PlaneOptions& options) : file_(file), options_(options) {}

  PlaneShapes read() {
    const pugi::xml_node root = file_.root("svg");
    children(root, page(root), options_.id.empty(), 0);
    if (lines_ > 0)
      file_.diagnostics().warning({make_source(file_.name(), ""), 0, 0},
                                  "lines without an area are left out: strokes and texts are not outlined",
                                  "turn strokes and texts into paths in the program that made the file");
    return std::move(shapes_);
  }

 private:
  double length(pugi::xml_node node, const char* name, double otherwise = 0) const {
    const auto text = file_.attribute(node, name);
    return text ? millimetres(*text, 1).value_or(otherwise) : otherwise;
  }

  // Returns a length with a unit in mm; `unitless` is the length in mm of a unit-less 1.
  std::optional<double> millimetres(std::string_view text, double unitless) const {
    const std::vector<double> numbers = read_svg_numbers(text, 1);
    if (numbers.empty()) return std::nullopt;
    constexpr double inch = 25.4;
    const double unit = text == "mm"   ? 1
                        : text == "cm" ? 10
                        : text == "in" ? inch
                        : text == "pt" ? inch / 72
                        : text == "pc" ? inch / 6
                        : text == "%"  ? std::nan("")
                                       : unitless;
    if (std::isnan(unit)) return std::nullopt;
    return numbers[0] * unit;
  }

  // Returns the map from the file's units to mm with y up.
  PlaneMap page(pugi::xml_node root) const {
    const double pixel = 25.4 / options_.dots_per_inch;
    const auto side = [&](const char* name) {
      const auto text = file_.attribute(root, name);
      return text ? millimetres(*text, pixel) : std::nullopt;
    };
    std::vector<double> box;
    if (auto text = file_.attribute(root, "viewBox")) box = read_svg_numbers(*text, 4);
    const auto width = side("width"), height = side("height");
    if (box.size() < 4 || !(box[2] > 0) || !(box[3] > 0)) return {1, 0, 0, -1, 0, height.value_or(0)};
    const double sx = width ? *width / box[2] : pixel, sy = height ? *height / box[3] : pixel;
    return {sx, 0, 0, -sy, -sx * box[0], height.value_or(pixel * box[3]) - sy * box[1]};
  }

  PlaneMap transform_of(pugi::xml_node node) const {
    PlaneMap map;
    auto text = file_.attribute(node, "transform");
    while (text) {
      const size_t begin = text->find_first_not_of(", \t\r\n");
      if (begin == std::string_view::npos) break;
      text->remove_prefix(begin);
      const size_t open = text->find('('), close = text->find(')');
      if (open == std::string_view::npos || close == std::string_view::npos || close < open)
        file_.fail_at(node, "the transform is no list of functions", "write for example translate(3, 4) scale(2)");
      std::string_view name = text->substr(0, open), arguments = text->substr(open + 1, close - open - 1);
      while (name.ends_with(' ')) name.remove_suffix(1);
      const auto next = map_of(name, read_svg_numbers(arguments, 6));
      if (!next) file_.fail_at(node, "the transform has an unknown function, or too few numbers: " + quoted(name));
      map = map * *next;
      text->remove_prefix(close + 1);
    }
    return map;
  }

  bool is_hidden(pugi::xml_node node) const {
    const auto display = file_.attribute(node, "display");
    const auto style = file_.attribute(node, "style");
    return (display && *display == "none") || (style && style->find("display:none") != std::string_view::npos);
  }

  void children(pugi::xml_node node, const PlaneMap& map, bool is_wanted, int depth) {
    if (depth > deepest_element) file_.fail_at(node, "elements lie more than 1000 deep within each other");
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element || is_hidden(child)) continue;
      const auto id = file_.attribute(child, "id");
      element(child, map * transform_of(child), is_wanted || (id && *id == options_.id), depth);
    }
  }

  void element(pugi::xml_node node, const PlaneMap& map, bool is_wanted, int depth) {
    const std::string_view kind = local_name(node);
    if (kind == "g" || kind == "svg" || kind == "a" || kind == "switch")
      return children(node, map, is_wanted, depth + 1);
    if (!is_wanted) return;
    std::vector<Ring> rings;
    if (kind == "path")
      rings = path(node);
    else if (kind == "rect")
      rings = {rectangle(node)};
    else if (kind == "circle" || kind == "ellipse")
      rings = {ellipse(node, kind == "circle")};
    else if (kind == "polygon" || kind == "polyline")
      rings = {polygon(node)};
    else if (kind == "line" || kind == "text")
      ++lines_;
    std::erase_if(rings, [&](const Ring& ring) { return ring.size() < 3; });
    for (Ring& ring : rings)
      for (Vec2& p : ring) p = map(p);
    if (!rings.empty()) shapes_.shapes.push_back(std::move(rings));
  }

  std::vector<Ring> path(pugi::xml_node node) const {
    const auto data = file_.attribute(node, "d");
    if (!data) return {};
    SvgPath path = read_svg_path(*data, options_.chords_per_turn);
    if (!path.error.empty()) file_.fail_at(node, path.error);
    return std::move(path.rings);
  }

  Ring polygon(pugi::xml_node node) const {
    auto text = file_.attribute(node, "points");
    if (!text) return {};
    const std::vector<double> numbers = read_svg_numbers(*text, SIZE_MAX);
    Ring ring;
    for (size_t n = 0; n + 1 < numbers.size(); n += 2) ring.push_back({numbers[n], numbers[n + 1]});
    return ring;
  }

  Ring ellipse(pugi::xml_node node, bool is_circle) const {
    const double rx = length(node, is_circle ? "r" : "rx"), ry = is_circle ? rx : length(node, "ry");
    if (!(rx > 0) || !(ry > 0)) return {};
    Ring ring;
    append_arc({{length(node, "cx"), length(node, "cy")}, {rx, 0}, {0, ry}}, options_.chords_per_turn, ring);
    ring.pop_back();  // the last point repeats the first
    return ring;
  }

  Ring rectangle(pugi::xml_node node) const {
    const double x = length(node, "x"), y = length(node, "y"), w = length(node, "width"), h = length(node, "height");
    if (!(w > 0) || !(h > 0)) return {};
    double rx = length(node, "rx", -1), ry = length(node, "ry", -1);
    if (rx < 0) rx = ry;
    if (ry < 0) ry = rx;
    rx = std::min(rx, w / 2);
    ry = std::min(ry, h / 2);
    if (!(rx > 0) || !(ry > 0)) return {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
    Ring ring;
    const std::array<Vec2, 4> centers{Vec2{x + w - rx, y + ry}, Vec2{x + w - rx, y + h - ry}, Vec2{x + rx, y + h - ry},
                                      Vec2{x + rx, y + ry}};
    constexpr double quarter = std::numbers::pi / 2;
    for (int n = 0; n < 4; ++n)
      append_arc({centers[static_cast<size_t>(n)], {rx, 0}, {0, ry}, (n - 1) * quarter, quarter},
                 options_.chords_per_turn, ring);
    return ring;
  }

  const XmlFile& file_;
  const PlaneOptions& options_;
  PlaneShapes shapes_;
  size_t lines_ = 0;
};

}  // namespace

std::optional<PlaneShapes> read_svg(const std::string& name, std::string_view bytes, const PlaneOptions& options,
                                    Diagnostics& diagnostics) {
  try {
    const XmlFile file(name, bytes, diagnostics);
    return SvgReader(file, options).read();
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

}  // namespace ombre::formats

#else

namespace ombre::formats {

std::optional<PlaneShapes> read_svg(const std::string& name, std::string_view, const PlaneOptions&,
                                    Diagnostics& diagnostics) {
  diagnostics.error(Code::library_missing, {make_source(name, ""), 0, 0},
                    "SVG files cannot be read: this ombre was built without pugixml",
                    "install libpugixml-dev, configure with -DOMBRE_3MF=ON and build again");
  return std::nullopt;
}

}  // namespace ombre::formats

#endif

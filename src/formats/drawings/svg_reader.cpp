// Reads SVG files.
#include "formats/drawings/plane_files.h"

#ifdef OMBRE_3MF

#include <array>
#include <cmath>
#include <set>
#include <unordered_map>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/containers/xml_file.h"
#include "formats/drawings/arcs.h"
#include "formats/drawings/svg_page.h"
#include "formats/drawings/svg_path.h"
#include "formats/drawings/svg_style.h"

namespace ombre::formats {
namespace {

constexpr size_t most_elements = 2'000'000, most_svg_points = 10'000'000;

// The style that an element inherits.
struct Style {
  bool is_visible = true, is_filled = true, is_stroked = false;
  bool is_evenodd = false, is_clip_evenodd = false;
  std::string_view stroke_width = "1", miter_limit = "4";
  bool has_dashes = false;
  StrokeCap cap = StrokeCap::butt;
  StrokeJoin join = StrokeJoin::miter;
};

// The place of an element, and the style that applies to it.
struct State {
  PlaneMap map;
  Vec2 view;  // the viewport's size in the element's units, for percentages
  Style style;
  std::vector<PlaneClip> clips = {};
  bool is_wanted = true;
  bool is_clip = false;  // the element is part of a clip path
  int depth = 0;
};

// Outlines in an element's own units.
struct Outlines {
  std::vector<Ring> closed, open;
};

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

std::vector<Ring> mapped(const std::vector<Ring>& rings, const PlaneMap& map) {
  std::vector<Ring> result = rings;
  for (Ring& ring : result)
    for (Vec2& p : ring) p = map(p);
  return result;
}

// The rings of a shape, each list with the map that takes it to mm.
std::vector<std::pair<const std::vector<Ring>*, PlaneMap>> rings_of(const PlaneShape& shape) {
  if (!shape.stroke) return {{&shape.rings, {}}};
  return {{&shape.rings, {}}, {&shape.stroke->open, shape.stroke->map}, {&shape.stroke->closed, shape.stroke->map}};
}

class SvgReader {
 public:
  SvgReader(const XmlFile& file, const PlaneOptions& options)
      : file_(file), options_(options), root_(file.root("svg")), sheet_(file, root_) {
    index_ids(root_, 0);
  }

  PlaneShapes read() {
    State state;
    state.is_wanted = options_.id.empty();
    begin_page(state);
    state.style = inherited(state, sheet_.values_of(root_));
    children(root_, state, shapes_.shapes);
    tell_left_out();
    return std::move(shapes_);
  }

 private:
  using Shapes = std::vector<PlaneShape>;

  void index_ids(pugi::xml_node node, int depth) {
    if (depth > deepest_svg_element) file_.fail_at(node, "elements lie more than 1000 deep within each other");
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      if (const std::string_view id = child.attribute("id").value(); !id.empty()) ids_.emplace(id, child);
      index_ids(child, depth + 1);
    }
  }

  // Attributes that a style sheet cannot set.
  static std::string_view attribute(pugi::xml_node node, const char* name) {
    return trim(node.attribute(name).value());
  }

  static std::string_view value(const SvgValues& values, std::string_view name) {
    const auto found = values.find(name);
    return found == values.end() ? std::string_view() : found->second;
  }

  // Returns a length in the element's units; `whole` is the length of 100 %.
  double length(pugi::xml_node node, std::string_view text, double whole, double otherwise = 0) const {
    if (text.empty() || text == "auto" || text == "inherit") return otherwise;
    const auto length = read_svg_length(text);
    if (length && (length->unit.empty() || length->unit == "px")) return length->number;
    if (length && length->unit == "%") {
      if (whole > 0) return length->number / 100 * whole;
      file_.fail_at(node, quoted(text) + " has no length, since the drawing has no size",
                    "give <svg> a viewBox or a width and a height");
    }
    const auto unit = length ? millimetres_of_unit(length->unit) : std::nullopt;
    if (!unit) file_.fail_at(node, "expected a length, found " + quoted(text), "write for example 12.5 or 3mm");
    return length->number * *unit / unit_mm_;
  }
  double across(const Vec2& view) const { return std::sqrt((view.x * view.x + view.y * view.y) / 2); }

  void begin_page(State& state);
  static Style inherited(const State& state, const SvgValues& values);
  PlaneMap transform_of(pugi::xml_node node, const SvgValues& values) const;
  std::optional<State> state_of(pugi::xml_node node, const State& outer, const SvgValues& values);

  void children(pugi::xml_node node, const State& state, Shapes& shapes);
  void element(pugi::xml_node node, const State& outer, Shapes& shapes);
  void first_child(pugi::xml_node node, const State& state, Shapes& shapes);
  void use(pugi::xml_node node, const SvgValues& values, State state, Shapes& shapes);
  void viewport(pugi::xml_node node, const SvgBox& place, State state, Shapes& shapes);
  PlaneClip clip_of(pugi::xml_node node, std::string_view text, const State& state);
  pugi::xml_node referred(pugi::xml_node node, std::string_view reference) const;

  void draw(pugi::xml_node node, const Outlines& outlines, const SvgValues& values, const State& state, Shapes& shapes);
  void add(PlaneShape shape, const State& state, Shapes& shapes);
  PlaneStroke stroke(pugi::xml_node node, const State& state) const;

  std::optional<Outlines> outlines_of(pugi::xml_node node, const SvgValues& values, const State& state) const;
  Outlines path(pugi::xml_node node, const SvgValues& values) const;
  Ring points(pugi::xml_node node) const;
  Ring ellipse(pugi::xml_node node, const SvgValues& values, const State& state, bool is_circle) const;
  Ring rectangle(pugi::xml_node node, const SvgValues& values, const State& state) const;

  void leave_out(const std::string& kind, const State& state) {
    if (state.is_wanted && state.style.is_visible) ++shapes_.left_out[kind];
  }
  void tell_left_out() const;

  const XmlFile& file_;
  const PlaneOptions& options_;
  pugi::xml_node root_;
  SvgSheet sheet_;
  PlaneShapes shapes_;
  std::unordered_map<std::string_view, pugi::xml_node> ids_;
  std::set<pugi::xml_node> in_use_;  // elements that are being drawn by references to them
  size_t elements_ = 0, points_ = 0, unfilled_ = 0, borders_ = 0;
  double unit_mm_ = 1;  // millimetres in a unit of the content, for lengths with absolute units
};

// As in OpenSCAD 2021.01, lengths are mm if there is no viewBox, and a viewBox with y other than 0 moves the picture
// down by that.
void SvgReader::begin_page(State& state) {
  constexpr double css_dots_per_inch = 96, inch = 25.4;
  const double pixel = inch / options_.dots_per_inch;
  bool is_absolute = false;
  const auto side = [&](const char* name) -> std::optional<double> {
    const auto length = read_svg_length(attribute(root_, name));
    if (!length || !(length->number > 0)) return std::nullopt;
    const auto unit = millimetres_of_unit(length->unit);
    is_absolute = is_absolute || unit;
    if (!unit && !length->unit.empty() && length->unit != "px") return std::nullopt;
    return length->number * unit.value_or(pixel);
  };
  const auto width = side("width"), height = side("height");
  const auto box = read_svg_box(attribute(root_, "viewBox"));
  if (!box) {
    state.map = {1, 0, 0, -1, 0, height.value_or(0)};
    state.view = {width.value_or(0), height.value_or(0)};
    return;
  }
  unit_mm_ = is_absolute ? inch / css_dots_per_inch : pixel;
  const double ratio = box->size.y / box->size.x;
  const Vec2 size{width    ? *width
                  : height ? *height / ratio
                           : pixel * box->size.x,
                  height  ? *height
                  : width ? *width * ratio
                          : pixel * box->size.y};
  const auto fit = fit_svg_box(*box, {{0, 0}, size}, attribute(root_, "preserveAspectRatio"));
  if (!fit) file_.fail_at(root_, "preserveAspectRatio is invalid", "write for example xMidYMid meet");
  const double moved_down = 2 * fit->d * box->corner.y;
  state.map = PlaneMap{1, 0, 0, -1, 0, size.y - moved_down} * *fit;
  state.view = box->size;
}

Style SvgReader::inherited(const State& state, const SvgValues& values) {
  Style style = state.style;
  for (const auto& [name, text] : values) {
    if (text == "inherit") continue;
    if (name == "visibility") style.is_visible = text == "visible";
    if (name == "fill") style.is_filled = text != "none" && text != "transparent";
    if (name == "stroke") style.is_stroked = text != "none" && text != "transparent";
    if (name == "fill-rule") style.is_evenodd = text == "evenodd";
    if (name == "clip-rule") style.is_clip_evenodd = text == "evenodd";
    if (name == "stroke-width") style.stroke_width = text;
    if (name == "stroke-miterlimit") style.miter_limit = text;
    if (name == "stroke-dasharray") style.has_dashes = text != "none" && !text.empty();
    if (name == "stroke-linecap")
      style.cap = text == "round" ? StrokeCap::round : text == "square" ? StrokeCap::square : StrokeCap::butt;
    if (name == "stroke-linejoin")
      style.join = text == "round" ? StrokeJoin::round : text == "bevel" ? StrokeJoin::bevel : StrokeJoin::miter;
  }
  return style;
}

PlaneMap SvgReader::transform_of(pugi::xml_node node, const SvgValues& values) const {
  const std::string_view text = value(values, "transform");
  if (text.empty() || text == "none") return {};
  if (const std::string_view origin = value(values, "transform-origin");
      !is_one_of(origin, {"", "0", "0 0", "0px 0px"}))
    file_.fail_at(node, "transform-origin is not read", "write the origin into the transform");
  std::string wrong;
  const auto map = read_svg_transform(text, wrong);
  if (map) return *map;
  if (wrong.empty())
    file_.fail_at(node, "the transform is no list of functions", "write for example translate(3, 4) scale(2)");
  file_.fail_at(node, "the transform has an unknown function, or too few numbers: " + quoted(wrong));
}

// Returns the state within an element; null if it is not displayed.
std::optional<State> SvgReader::state_of(pugi::xml_node node, const State& outer, const SvgValues& values) {
  if (value(values, "display") == "none") return std::nullopt;
  State state = outer;
  ++state.depth;
  if (state.depth > deepest_svg_element) file_.fail_at(node, "elements lie more than 1000 deep within each other");
  state.style = inherited(outer, values);
  state.map = outer.map * transform_of(node, values);
  state.is_wanted = outer.is_wanted || (!options_.id.empty() && options_.id == node.attribute("id").value());
  if (!state.is_wanted) return state;
  if (const std::string_view mask = value(values, "mask"); !is_one_of(mask, {"", "none"}))
    file_.fail_at(node, "a mask is not read, and it could change shapes", "draw the masked shapes in the program");
  if (const std::string_view clip = value(values, "clip-path"); !is_one_of(clip, {"", "none"}))
    state.clips.push_back(clip_of(node, clip, state));
  return state;
}

void SvgReader::children(pugi::xml_node node, const State& state, Shapes& shapes) {
  for (const pugi::xml_node child : node.children())
    if (child.type() == pugi::node_element) element(child, state, shapes);
}

// Draws the first child whose conditions hold (SVG 1.1, section 5.8.2).
void SvgReader::first_child(pugi::xml_node node, const State& state, Shapes& shapes) {
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element || is_one_of(local_name(child), {"title", "desc", "metadata"})) continue;
    if (child.attribute("requiredExtensions") || local_name(child) == "foreignObject") continue;
    const pugi::xml_attribute language = child.attribute("systemLanguage");
    if (language && std::string_view(language.value()).find("en") == std::string_view::npos) continue;
    return element(child, state, shapes);
  }
}

void SvgReader::element(pugi::xml_node node, const State& outer, Shapes& shapes) {
  if (++elements_ > most_elements) file_.fail_at(node, "the drawing uses more than two million elements");
  const std::string_view kind = local_name(node);
  // Elements of other namespaces have a prefix that the root lacks.
  const std::string_view name = node.name(), root = root_.name();
  if (name.substr(0, name.size() - kind.size()) != root.substr(0, root.size() - 3)) return;
  if (is_one_of(kind, {"defs",
                       "symbol",
                       "clipPath",
                       "mask",
                       "marker",
                       "pattern",
                       "linearGradient",
                       "radialGradient",
                       "meshgradient",
                       "hatch",
                       "filter",
                       "style",
                       "script",
                       "title",
                       "desc",
                       "metadata",
                       "view",
                       "cursor",
                       "font",
                       "font-face",
                       "color-profile",
                       "animate",
                       "animateTransform",
                       "animateMotion",
                       "animateColor",
                       "set"}))
    return;
  const SvgValues values = sheet_.values_of(node);
  const auto state = state_of(node, outer, values);
  if (!state) return;
  if (is_one_of(kind, {"g", "a"})) return children(node, *state, shapes);
  if (kind == "switch") return first_child(node, *state, shapes);
  if (kind == "use") return use(node, values, *state, shapes);
  if (kind == "svg") {
    const Vec2 view = state->view;
    const Vec2 corner{length(node, attribute(node, "x"), view.x), length(node, attribute(node, "y"), view.y)};
    const Vec2 size{length(node, attribute(node, "width"), view.x, view.x),
                    length(node, attribute(node, "height"), view.y, view.y)};
    return viewport(node, {corner, size}, *state, shapes);
  }
  if (!state->is_wanted || !state->style.is_visible) return;
  if (const auto outlines = outlines_of(node, values, *state)) return draw(node, *outlines, values, *state, shapes);
  leave_out(kind == "text" || kind == "image" ? std::string(kind) + "s" : "elements <" + std::string(kind) + ">",
            *state);
}

pugi::xml_node SvgReader::referred(pugi::xml_node node, std::string_view reference) const {
  if (!reference.starts_with('#'))
    file_.fail_at(node, "a reference to another file is not read: " + quoted(reference),
                  "copy what it refers to into this file");
  const auto found = ids_.find(reference.substr(1));
  if (found == ids_.end()) file_.fail_at(node, "no element has the id " + quoted(reference.substr(1)));
  return found->second;
}

void SvgReader::use(pugi::xml_node node, const SvgValues& values, State state, Shapes& shapes) {
  std::string_view reference = attribute(node, "href");
  if (reference.empty()) reference = trim(file_.attribute(node, "href").value_or(""));
  if (reference.empty()) return;
  const pugi::xml_node target = referred(node, reference);
  if (!in_use_.insert(target).second) file_.fail_at(node, quoted(reference) + " uses itself");
  const Vec2 view = state.view;
  state.map = state.map *
              PlaneMap{1, 0, 0, 1, length(node, value(values, "x"), view.x), length(node, value(values, "y"), view.y)};
  const std::string_view kind = local_name(target);
  if (kind == "symbol" || kind == "svg") {
    const SvgValues own = sheet_.values_of(target);
    if (const auto inner = state_of(target, state, own)) {
      const auto side = [&](const char* name, double whole) {
        const std::string_view text = value(values, name);
        return length(node, text.empty() ? attribute(target, name) : text, whole, whole);
      };
      const bool is_placed = kind == "svg";
      const Vec2 corner{is_placed ? length(target, attribute(target, "x"), view.x) : 0,
                        is_placed ? length(target, attribute(target, "y"), view.y) : 0};
      viewport(target, {corner, {side("width", view.x), side("height", view.y)}}, *inner, shapes);
    }
  } else {
    element(target, state, shapes);
  }
  in_use_.erase(target);
}

// Draws the contents of a nested picture or symbol, cut to its viewport unless they may overflow it.
void SvgReader::viewport(pugi::xml_node node, const SvgBox& place, State state, Shapes& shapes) {
  const auto box = read_svg_box(attribute(node, "viewBox"));
  const bool has_size = place.size.x > 0 && place.size.y > 0;
  if (box && !has_size) return;
  if (has_size && !is_one_of(value(sheet_.values_of(node), "overflow"), {"visible", "auto"})) {
    const Vec2 a = place.corner, b = a + place.size;
    PlaneShape window;
    window.rings = mapped({{a, {b.x, a.y}, b, {a.x, b.y}}}, state.map);
    state.clips.push_back(std::make_shared<const Shapes>(Shapes{std::move(window)}));
  }
  if (box) {
    const auto fit = fit_svg_box(*box, place, attribute(node, "preserveAspectRatio"));
    if (!fit) file_.fail_at(node, "preserveAspectRatio is invalid", "write for example xMidYMid meet");
    state.map = state.map * *fit;
    state.view = box->size;
  } else {
    state.map = state.map * PlaneMap{1, 0, 0, 1, place.corner.x, place.corner.y};
    if (has_size) state.view = place.size;
  }
  children(node, state, shapes);
}

PlaneClip SvgReader::clip_of(pugi::xml_node node, std::string_view text, const State& state) {
  const size_t open = text.find('('), close = text.rfind(')');
  if (!text.starts_with("url") || open == std::string_view::npos || close == std::string_view::npos || close < open)
    file_.fail_at(node, "the clip path " + quoted(text) + " is not read", "write for example url(#name)");
  std::string_view reference = trim(text.substr(open + 1, close - open - 1));
  while (!reference.empty() && (reference[0] == '"' || reference[0] == '\'')) reference.remove_prefix(1);
  while (!reference.empty() && (reference.back() == '"' || reference.back() == '\'')) reference.remove_suffix(1);
  const pugi::xml_node target = referred(node, reference);
  const SvgValues values = sheet_.values_of(target);
  if (local_name(target) != "clipPath") file_.fail_at(node, quoted(reference) + " is no <clipPath>");
  if (attribute(target, "clipPathUnits") == "objectBoundingBox" || !value(values, "clip-path").empty())
    file_.fail_at(target, "a clip path relative to a shape's box, or with a clip path of its own, is not read",
                  "give it clipPathUnits=\"userSpaceOnUse\"");
  if (!in_use_.insert(target).second) file_.fail_at(node, quoted(reference) + " uses itself");
  State inner;
  inner.map = state.map * transform_of(target, values);
  inner.view = state.view;
  inner.is_clip = true;
  inner.depth = state.depth + 1;
  inner.style = inherited(inner, values);
  auto shapes = std::make_shared<Shapes>();
  children(target, inner, *shapes);
  in_use_.erase(target);
  return shapes;
}

PlaneStroke SvgReader::stroke(pugi::xml_node node, const State& state) const {
  PlaneStroke stroke;
  stroke.width = length(node, state.style.stroke_width, across(state.view), 1);
  stroke.miter_limit = std::max(1.0, length(node, state.style.miter_limit, 0, 4));
  stroke.cap = state.style.cap;
  stroke.join = state.style.join;
  stroke.map = state.map;
  return stroke;
}

void SvgReader::add(PlaneShape shape, const State& state, Shapes& shapes) {
  size_t points = 0;
  for (const auto& [rings, map] : rings_of(shape))
    for (const Ring& ring : *rings) points += ring.size();
  if ((points_ += points) > most_svg_points)
    fail(file_.diagnostics(), file_.name(), "the drawing has more than ten million points");
  constexpr double farthest = 1e15;
  const auto reaches_too_far = [](const Ring& ring, const PlaneMap& map) {
    return std::ranges::any_of(ring, [&](const Vec2& own) {
      const Vec2 p = map(own);
      return !(std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(own.x) <= farthest &&
               std::abs(own.y) <= farthest);
    });
  };
  for (const auto& [rings, map] : rings_of(shape))
    for (const Ring& ring : *rings)
      if (reaches_too_far(ring, map)) fail(file_.diagnostics(), file_.name(), "the drawing reaches farther than 10^15");
  shape.clips = state.clips;
  shapes.push_back(std::move(shape));
}

void SvgReader::draw(pugi::xml_node node, const Outlines& outlines, const SvgValues& values, const State& state,
                     Shapes& shapes) {
  const Style& style = state.style;
  const bool is_line = local_name(node) == "line";
  const bool is_filled = state.is_clip || (style.is_filled && !is_line && value(values, "fill-opacity") != "0");
  const bool is_stroked = !state.is_clip && style.is_stroked && stroke(node, state).width > 0;
  PlaneShape area;
  area.is_nonzero = !(state.is_clip ? style.is_clip_evenodd : style.is_evenodd);
  PlaneStroke lines;
  size_t open = 0;
  const auto sort = [&](const std::vector<Ring>& rings, bool is_closed) {
    for (const Ring& ring : rings) {
      const bool encloses = ring.size() > 2 && (is_filled || (is_closed && !options_.is_painted));
      if (encloses) area.rings.push_back(ring);
      if (encloses && !is_filled) ++unfilled_;
      if (encloses && is_stroked && !options_.is_painted) ++borders_;
      if ((ring.size() > 1 || is_closed) && is_stroked && (!encloses || options_.is_painted))
        (is_closed ? lines.closed : lines.open).push_back(ring);
      else if (!encloses && ring.size() > 1)
        ++open;
    }
  };
  sort(outlines.closed, true);
  sort(outlines.open, false);
  if (open > 0 && !state.is_clip) shapes_.left_out["outlines without a fill and a stroke"] += open;
  if (!area.rings.empty()) {
    area.rings = mapped(area.rings, state.map);
    add(std::move(area), state, shapes);
  }
  if (lines.open.empty() && lines.closed.empty()) return;
  if (const std::string_view effect = value(values, "vector-effect"); !is_one_of(effect, {"", "none"}))
    file_.fail_at(node, "vector-effect " + quoted(effect) + " of a stroke is not read", "turn the stroke into a path");
  if (style.has_dashes) ++shapes_.left_out["gaps of dashed lines"];
  PlaneShape drawn;
  drawn.stroke = stroke(node, state);
  drawn.stroke->open = std::move(lines.open);
  drawn.stroke->closed = std::move(lines.closed);
  add(std::move(drawn), state, shapes);
}

// Returns the outlines of an element; null if it is no shape.
std::optional<Outlines> SvgReader::outlines_of(pugi::xml_node node, const SvgValues& values, const State& state) const {
  const std::string_view kind = local_name(node);
  const Vec2 view = state.view;
  const auto closed = [](Ring ring) {
    Outlines outlines;
    if (!ring.empty()) outlines.closed.push_back(std::move(ring));
    return outlines;
  };
  if (kind == "path") return path(node, values);
  if (kind == "rect") return closed(rectangle(node, values, state));
  if (kind == "circle" || kind == "ellipse") return closed(ellipse(node, values, state, kind == "circle"));
  if (kind == "polygon") return closed(points(node));
  if (kind == "polyline") {
    Ring ring = points(node);
    const bool is_closed = ring.size() > 3 && ring.front() == ring.back();
    return is_closed ? closed(std::move(ring)) : Outlines{{}, {std::move(ring)}};
  }
  if (kind != "line") return std::nullopt;
  const auto place = [&](const char* x, const char* y) {
    return Vec2{length(node, attribute(node, x), view.x), length(node, attribute(node, y), view.y)};
  };
  return Outlines{{}, {{place("x1", "y1"), place("x2", "y2")}}};
}

Outlines SvgReader::path(pugi::xml_node node, const SvgValues& values) const {
  SvgPath path = read_svg_path(value(values, "d"), options_.chords_per_turn);
  if (!path.error.empty()) file_.fail_at(node, path.error);
  Outlines outlines;
  for (size_t n = 0; n < path.rings.size(); ++n) {
    Ring& ring = path.rings[n];
    // Programs round the end of an outline that they do not close by a command.
    constexpr double same = 1e-3;
    const bool is_closed = path.is_closed[n] || (ring.size() > 3 && ombre::length(ring.front() - ring.back()) < same);
    (is_closed ? outlines.closed : outlines.open).push_back(std::move(ring));
  }
  return outlines;
}

Ring SvgReader::points(pugi::xml_node node) const {
  std::string_view text = attribute(node, "points");
  const std::vector<double> numbers = read_svg_numbers(text, SIZE_MAX);
  if (!trim(text).empty()) file_.fail_at(node, "expected a number among the points, found " + quoted(text));
  Ring ring;
  for (size_t n = 0; n + 1 < numbers.size(); n += 2) ring.push_back({numbers[n], numbers[n + 1]});
  return ring;
}

Ring SvgReader::ellipse(pugi::xml_node node, const SvgValues& values, const State& state, bool is_circle) const {
  const Vec2 view = state.view;
  double rx = 0, ry = 0;
  if (is_circle) {
    rx = ry = length(node, value(values, "r"), across(view));
  } else {
    rx = length(node, value(values, "rx"), view.x, -1);
    ry = length(node, value(values, "ry"), view.y, -1);
    if (rx < 0) rx = ry;
    if (ry < 0) ry = rx;
  }
  if (!(rx > 0) || !(ry > 0)) return {};
  const Vec2 center{length(node, value(values, "cx"), view.x), length(node, value(values, "cy"), view.y)};
  Ring ring;
  append_arc({center, {rx, 0}, {0, ry}}, options_.chords_per_turn, ring);
  ring.pop_back();  // the last point repeats the first
  return ring;
}

Ring SvgReader::rectangle(pugi::xml_node node, const SvgValues& values, const State& state) const {
  const Vec2 view = state.view;
  const double x = length(node, value(values, "x"), view.x), y = length(node, value(values, "y"), view.y);
  const double w = length(node, value(values, "width"), view.x), h = length(node, value(values, "height"), view.y);
  if (!(w > 0) || !(h > 0)) return {};
  double rx = length(node, value(values, "rx"), view.x, -1), ry = length(node, value(values, "ry"), view.y, -1);
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

void SvgReader::tell_left_out() const {
  const SourceRange where{make_source(file_.name(), ""), 0, 0};
  Diagnostics& diagnostics = file_.diagnostics();
  if (!shapes_.left_out.empty())
    diagnostics.warning(where, "left out of the drawing: " + text_of_left_out(shapes_.left_out),
                        "turn texts and strokes into paths in the program that made the file");
  if (unfilled_ > 0)
    diagnostics.note(where, std::to_string(unfilled_) +
                                " closed outlines have no fill and are areas all the same; strokes=true reads the "
                                "drawing as it is painted");
  if (borders_ > 0 && unfilled_ == 0)
    diagnostics.note(where, std::to_string(borders_) +
                                " areas have a stroke, which is left out; strokes=true makes it part of them");
  if (!options_.id.empty() && !ids_.contains(options_.id))
    diagnostics.warning(where, "no element has the id " + quoted(options_.id));
}

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

// Reads SVG files.
#include "formats/drawings/plane_files.h"

#ifdef OMBRE_3MF

#include <set>
#include <unordered_map>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/containers/xml_file.h"
#include "formats/drawings/svg_canvas.h"
#include "formats/drawings/svg_page.h"

namespace ombre::formats {
namespace {

constexpr size_t most_elements = 2'000'000;

class SvgReader {
 public:
  SvgReader(const XmlFile& file, const PlaneOptions& options)
      : file_(file),
        options_(options),
        root_(file.root("svg")),
        sheet_(file, root_),
        measures_(file),
        outlines_(measures_, options.chords_per_turn),
        canvas_(measures_, options) {
    index_ids(root_, 0);
  }

  PlaneShapes read() {
    SvgState state;
    state.is_wanted = options_.id.empty();
    begin_page(state);
    state.style = inherited_style(state.style, sheet_.values_of(root_));
    children(root_, state, canvas_.drawn().shapes);
    canvas_.tell_left_out();
    if (!options_.id.empty() && !ids_.contains(options_.id))
      file_.diagnostics().warning({make_source(file_.name(), ""), 0, 0},
                                  "no element has the id " + quoted(options_.id));
    return std::move(canvas_.drawn());
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

  void begin_page(SvgState& state);
  PlaneMap transform_of(pugi::xml_node node, const SvgValues& values) const;
  std::optional<SvgState> state_of(pugi::xml_node node, const SvgState& outer, const SvgValues& values);

  void children(pugi::xml_node node, const SvgState& state, Shapes& shapes);
  void element(pugi::xml_node node, const SvgState& outer, Shapes& shapes);
  void first_child(pugi::xml_node node, const SvgState& state, Shapes& shapes);
  void use(pugi::xml_node node, const SvgValues& values, SvgState state, Shapes& shapes);
  void viewport(pugi::xml_node node, const SvgBox& place, SvgState state, Shapes& shapes);
  PlaneClip clip_of(pugi::xml_node node, std::string_view text, const SvgState& state);
  pugi::xml_node referred(pugi::xml_node node, std::string_view reference) const;

  const XmlFile& file_;
  const PlaneOptions& options_;
  pugi::xml_node root_;
  SvgSheet sheet_;
  SvgMeasures measures_;
  SvgShapes outlines_;
  SvgCanvas canvas_;
  std::unordered_map<std::string_view, pugi::xml_node> ids_;
  std::set<pugi::xml_node> in_use_;  // elements that are being drawn by references to them
  size_t elements_ = 0;
};

// Lengths are mm if there is no viewBox, and a viewBox with y other than 0 moves the picture down by that, as in
// OpenSCAD 2021.01.
void SvgReader::begin_page(SvgState& state) {
  constexpr double css_dots_per_inch = 96, inch = 25.4;
  const double pixel = inch / options_.dots_per_inch;
  bool is_absolute = false;
  const auto side = [&](const char* name) -> std::optional<double> {
    const auto length = read_svg_length(svg_attribute(root_, name));
    if (!length || !(length->number > 0)) return std::nullopt;
    const auto unit = millimetres_of_unit(length->unit);
    is_absolute = is_absolute || unit;
    if (!unit && !length->unit.empty() && length->unit != "px") return std::nullopt;
    return length->number * unit.value_or(pixel);
  };
  const auto width = side("width"), height = side("height");
  const auto box = read_svg_box(svg_attribute(root_, "viewBox"));
  if (!box) {
    state.map = {1, 0, 0, -1, 0, height.value_or(0)};
    state.view = {width.value_or(0), height.value_or(0)};
    return;
  }
  measures_.set_unit(is_absolute ? inch / css_dots_per_inch : pixel);
  const double ratio = box->size.y / box->size.x;
  const Vec2 size{width    ? *width
                  : height ? *height / ratio
                           : pixel * box->size.x,
                  height  ? *height
                  : width ? *width * ratio
                          : pixel * box->size.y};
  const auto fit = fit_svg_box(*box, {{0, 0}, size}, svg_attribute(root_, "preserveAspectRatio"));
  if (!fit) file_.fail_at(root_, "preserveAspectRatio is invalid", "write for example xMidYMid meet");
  const double moved_down = 2 * fit->d * box->corner.y;
  state.map = PlaneMap{1, 0, 0, -1, 0, size.y - moved_down} * *fit;
  state.view = box->size;
}

PlaneMap SvgReader::transform_of(pugi::xml_node node, const SvgValues& values) const {
  const std::string_view text = svg_value(values, "transform");
  if (text.empty() || text == "none") return {};
  if (const std::string_view origin = svg_value(values, "transform-origin");
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
std::optional<SvgState> SvgReader::state_of(pugi::xml_node node, const SvgState& outer, const SvgValues& values) {
  if (svg_value(values, "display") == "none") return std::nullopt;
  SvgState state = outer;
  ++state.depth;
  if (state.depth > deepest_svg_element) file_.fail_at(node, "elements lie more than 1000 deep within each other");
  state.style = inherited_style(outer.style, values);
  state.map = outer.map * transform_of(node, values);
  state.is_wanted = outer.is_wanted || (!options_.id.empty() && options_.id == node.attribute("id").value());
  if (!state.is_wanted) return state;
  if (const std::string_view mask = svg_value(values, "mask"); !is_one_of(mask, {"", "none"}))
    file_.fail_at(node, "a mask is not read, and it could change shapes", "draw the masked shapes in the program");
  if (const std::string_view clip = svg_value(values, "clip-path"); !is_one_of(clip, {"", "none"}))
    state.clips.push_back(clip_of(node, clip, state));
  return state;
}

void SvgReader::children(pugi::xml_node node, const SvgState& state, Shapes& shapes) {
  for (const pugi::xml_node child : node.children())
    if (child.type() == pugi::node_element) element(child, state, shapes);
}

// Draws the first child whose conditions hold (SVG 1.1, section 5.8.2).
void SvgReader::first_child(pugi::xml_node node, const SvgState& state, Shapes& shapes) {
  for (const pugi::xml_node child : node.children()) {
    if (child.type() != pugi::node_element || is_one_of(local_name(child), {"title", "desc", "metadata"})) continue;
    if (child.attribute("requiredExtensions") || local_name(child) == "foreignObject") continue;
    const pugi::xml_attribute language = child.attribute("systemLanguage");
    if (language && std::string_view(language.value()).find("en") == std::string_view::npos) continue;
    return element(child, state, shapes);
  }
}

void SvgReader::element(pugi::xml_node node, const SvgState& outer, Shapes& shapes) {
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
    const Vec2 corner{measures_.length(node, svg_attribute(node, "x"), view.x),
                      measures_.length(node, svg_attribute(node, "y"), view.y)};
    const Vec2 size{measures_.length(node, svg_attribute(node, "width"), view.x, view.x),
                    measures_.length(node, svg_attribute(node, "height"), view.y, view.y)};
    return viewport(node, {corner, size}, *state, shapes);
  }
  if (!state->is_wanted || !state->style.is_visible) return;
  if (const auto outlines = outlines_.outlines(node, values, state->view))
    return canvas_.draw(node, *outlines, values, *state, shapes);
  canvas_.leave_out(
      kind == "text" || kind == "image" ? std::string(kind) + "s" : "elements <" + std::string(kind) + ">", *state);
}

pugi::xml_node SvgReader::referred(pugi::xml_node node, std::string_view reference) const {
  if (!reference.starts_with('#'))
    file_.fail_at(node, "a reference to another file is not read: " + quoted(reference),
                  "copy what it refers to into this file");
  const auto found = ids_.find(reference.substr(1));
  if (found == ids_.end()) file_.fail_at(node, "no element has the id " + quoted(reference.substr(1)));
  return found->second;
}

void SvgReader::use(pugi::xml_node node, const SvgValues& values, SvgState state, Shapes& shapes) {
  std::string_view reference = svg_attribute(node, "href");
  if (reference.empty()) reference = trim(file_.attribute(node, "href").value_or(""));
  if (reference.empty()) return;
  const pugi::xml_node target = referred(node, reference);
  if (!in_use_.insert(target).second) file_.fail_at(node, quoted(reference) + " uses itself");
  const Vec2 view = state.view;
  state.map = state.map * PlaneMap{1,
                                   0,
                                   0,
                                   1,
                                   measures_.length(node, svg_value(values, "x"), view.x),
                                   measures_.length(node, svg_value(values, "y"), view.y)};
  const std::string_view kind = local_name(target);
  if (kind == "symbol" || kind == "svg") {
    const SvgValues own = sheet_.values_of(target);
    if (const auto inner = state_of(target, state, own)) {
      const auto side = [&](const char* name, double whole) {
        const std::string_view text = svg_value(values, name);
        return measures_.length(node, text.empty() ? svg_attribute(target, name) : text, whole, whole);
      };
      const bool is_placed = kind == "svg";
      const Vec2 corner{is_placed ? measures_.length(target, svg_attribute(target, "x"), view.x) : 0,
                        is_placed ? measures_.length(target, svg_attribute(target, "y"), view.y) : 0};
      viewport(target, {corner, {side("width", view.x), side("height", view.y)}}, *inner, shapes);
    }
  } else {
    element(target, state, shapes);
  }
  in_use_.erase(target);
}

// Draws the contents of a nested picture or symbol, cut to its viewport unless they may overflow it.
void SvgReader::viewport(pugi::xml_node node, const SvgBox& place, SvgState state, Shapes& shapes) {
  const auto box = read_svg_box(svg_attribute(node, "viewBox"));
  const bool has_size = place.size.x > 0 && place.size.y > 0;
  if (box && !has_size) return;
  if (has_size && !is_one_of(svg_value(sheet_.values_of(node), "overflow"), {"visible", "auto"})) {
    const Vec2 a = place.corner, b = a + place.size;
    PlaneShape window;
    window.rings = mapped({{a, {b.x, a.y}, b, {a.x, b.y}}}, state.map);
    state.clips.push_back(std::make_shared<const Shapes>(Shapes{std::move(window)}));
  }
  if (box) {
    const auto fit = fit_svg_box(*box, place, svg_attribute(node, "preserveAspectRatio"));
    if (!fit) file_.fail_at(node, "preserveAspectRatio is invalid", "write for example xMidYMid meet");
    state.map = state.map * *fit;
    state.view = box->size;
  } else {
    state.map = state.map * PlaneMap{1, 0, 0, 1, place.corner.x, place.corner.y};
    if (has_size) state.view = place.size;
  }
  children(node, state, shapes);
}

PlaneClip SvgReader::clip_of(pugi::xml_node node, std::string_view text, const SvgState& state) {
  const size_t open = text.find('('), close = text.rfind(')');
  if (!text.starts_with("url") || open == std::string_view::npos || close == std::string_view::npos || close < open)
    file_.fail_at(node, "the clip path " + quoted(text) + " is not read", "write for example url(#name)");
  std::string_view reference = trim(text.substr(open + 1, close - open - 1));
  while (!reference.empty() && (reference[0] == '"' || reference[0] == '\'')) reference.remove_prefix(1);
  while (!reference.empty() && (reference.back() == '"' || reference.back() == '\'')) reference.remove_suffix(1);
  const pugi::xml_node target = referred(node, reference);
  const SvgValues values = sheet_.values_of(target);
  if (local_name(target) != "clipPath") file_.fail_at(node, quoted(reference) + " is no <clipPath>");
  if (svg_attribute(target, "clipPathUnits") == "objectBoundingBox" || !svg_value(values, "clip-path").empty())
    file_.fail_at(target, "a clip path relative to a shape's box, or with a clip path of its own, is not read",
                  "give it clipPathUnits=\"userSpaceOnUse\"");
  if (!in_use_.insert(target).second) file_.fail_at(node, quoted(reference) + " uses itself");
  SvgState inner;
  inner.map = state.map * transform_of(target, values);
  inner.view = state.view;
  inner.is_clip = true;
  inner.depth = state.depth + 1;
  inner.style = inherited_style(inner.style, values);
  auto shapes = std::make_shared<Shapes>();
  children(target, inner, *shapes);
  in_use_.erase(target);
  return shapes;
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

#include "formats/drawings/svg_canvas.h"

#ifdef OMBRE_3MF

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"

namespace ombre::formats {
namespace {

constexpr size_t most_svg_points = 10'000'000;

// The rings of a shape, each list with the map that takes it to mm.
std::vector<std::pair<const std::vector<Ring>*, PlaneMap>> rings_of(const PlaneShape& shape) {
  if (!shape.stroke) return {{&shape.rings, {}}};
  return {{&shape.rings, {}}, {&shape.stroke->open, shape.stroke->map}, {&shape.stroke->closed, shape.stroke->map}};
}

}  // namespace

std::vector<Ring> mapped(const std::vector<Ring>& rings, const PlaneMap& map) {
  std::vector<Ring> result = rings;
  for (Ring& ring : result)
    for (Vec2& p : ring) p = map(p);
  return result;
}

void SvgCanvas::leave_out(const std::string& kind, const SvgState& state) {
  if (state.is_wanted && state.style.is_visible) ++drawn_.left_out[kind];
}

PlaneStroke SvgCanvas::stroke(pugi::xml_node node, const SvgState& state) const {
  PlaneStroke stroke;
  stroke.width = measures_.length(node, state.style.stroke_width, diagonal_of(state.view), 1);
  stroke.miter_limit = std::max(1.0, measures_.length(node, state.style.miter_limit, 0, 4));
  stroke.cap = state.style.cap;
  stroke.join = state.style.join;
  stroke.map = state.map;
  return stroke;
}

void SvgCanvas::add(PlaneShape shape, const SvgState& state, std::vector<PlaneShape>& shapes) {
  size_t points = 0;
  for (const auto& [rings, map] : rings_of(shape))
    for (const Ring& ring : *rings) points += ring.size();
  if ((points_ += points) > most_svg_points)
    fail(measures_.file().diagnostics(), measures_.file().name(), "the drawing has more than ten million points");
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
      if (reaches_too_far(ring, map))
        fail(measures_.file().diagnostics(), measures_.file().name(), "the drawing reaches farther than 10^15");
  shape.clips = state.clips;
  shapes.push_back(std::move(shape));
}

void SvgCanvas::draw(pugi::xml_node node, const SvgOutlines& outlines, const SvgValues& values, const SvgState& state,
                     std::vector<PlaneShape>& shapes) {
  const SvgStyle& style = state.style;
  const bool is_line = local_name(node) == "line";
  const bool is_filled = state.is_clip || (style.is_filled && !is_line && svg_value(values, "fill-opacity") != "0");
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
  if (open > 0 && !state.is_clip) drawn_.left_out["outlines without a fill and a stroke"] += open;
  if (!area.rings.empty()) {
    area.rings = mapped(area.rings, state.map);
    add(std::move(area), state, shapes);
  }
  if (lines.open.empty() && lines.closed.empty()) return;
  if (const std::string_view effect = svg_value(values, "vector-effect"); !is_one_of(effect, {"", "none"}))
    measures_.file().fail_at(node, "vector-effect " + quoted(effect) + " of a stroke is not read",
                             "turn the stroke into a path");
  if (style.has_dashes) ++drawn_.left_out["gaps of dashed lines"];
  PlaneShape drawn;
  drawn.stroke = stroke(node, state);
  drawn.stroke->open = std::move(lines.open);
  drawn.stroke->closed = std::move(lines.closed);
  add(std::move(drawn), state, shapes);
}

void SvgCanvas::tell_left_out() const {
  const SourceRange where{make_source(measures_.file().name(), ""), 0, 0};
  Diagnostics& diagnostics = measures_.file().diagnostics();
  if (!drawn_.left_out.empty())
    diagnostics.warning(where, "left out of the drawing: " + text_of_left_out(drawn_.left_out),
                        "turn texts and strokes into paths in the program that made the file");
  if (unfilled_ > 0)
    diagnostics.note(where, std::to_string(unfilled_) +
                                " closed outlines have no fill and are areas all the same; strokes=true reads the "
                                "drawing as it is painted");
  if (borders_ > 0 && unfilled_ == 0)
    diagnostics.note(where, std::to_string(borders_) +
                                " areas have a stroke, which is left out; strokes=true makes it part of them");
}

}  // namespace ombre::formats

#endif

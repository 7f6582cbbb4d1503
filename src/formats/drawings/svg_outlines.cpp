#include "formats/drawings/svg_outlines.h"

#ifdef OMBRE_3MF

#include <array>
#include <cmath>

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/drawings/arcs.h"
#include "formats/drawings/svg_path.h"

namespace ombre::formats {

std::optional<SvgOutlines> SvgShapes::outlines(pugi::xml_node node, const SvgValues& values, const Vec2& view) const {
  const std::string_view kind = local_name(node);
  const auto closed = [](Ring ring) {
    SvgOutlines outlines;
    if (!ring.empty()) outlines.closed.push_back(std::move(ring));
    return outlines;
  };
  if (kind == "path") return path(node, values);
  if (kind == "rect") return closed(rectangle(node, values, view));
  if (kind == "circle" || kind == "ellipse") return closed(ellipse(node, values, view, kind == "circle"));
  if (kind == "polygon") return closed(points(node));
  if (kind == "polyline") {
    Ring ring = points(node);
    const bool is_closed = ring.size() > 3 && ring.front() == ring.back();
    return is_closed ? closed(std::move(ring)) : SvgOutlines{{}, {std::move(ring)}};
  }
  if (kind != "line") return std::nullopt;
  const auto place = [&](const char* x, const char* y) {
    return Vec2{measures_.length(node, svg_attribute(node, x), view.x),
                measures_.length(node, svg_attribute(node, y), view.y)};
  };
  return SvgOutlines{{}, {{place("x1", "y1"), place("x2", "y2")}}};
}

SvgOutlines SvgShapes::path(pugi::xml_node node, const SvgValues& values) const {
  SvgPath path = read_svg_path(svg_value(values, "d"), chords_per_turn_);
  if (!path.error.empty()) measures_.file().fail_at(node, path.error);
  SvgOutlines outlines;
  for (size_t n = 0; n < path.rings.size(); ++n) {
    Ring& ring = path.rings[n];
    // Programs round the end of an outline that they do not close by a command.
    constexpr double same = 1e-3;
    const bool is_closed = path.is_closed[n] || (ring.size() > 3 && ombre::length(ring.front() - ring.back()) < same);
    (is_closed ? outlines.closed : outlines.open).push_back(std::move(ring));
  }
  return outlines;
}

Ring SvgShapes::points(pugi::xml_node node) const {
  std::string_view text = svg_attribute(node, "points");
  const std::vector<double> numbers = read_svg_numbers(text, SIZE_MAX);
  if (!trim(text).empty()) measures_.file().fail_at(node, "expected a number among the points, found " + quoted(text));
  Ring ring;
  for (size_t n = 0; n + 1 < numbers.size(); n += 2) ring.push_back({numbers[n], numbers[n + 1]});
  return ring;
}

Ring SvgShapes::ellipse(pugi::xml_node node, const SvgValues& values, const Vec2& view, bool is_circle) const {
  double rx = 0, ry = 0;
  if (is_circle) {
    rx = ry = measures_.length(node, svg_value(values, "r"), diagonal_of(view));
  } else {
    rx = measures_.length(node, svg_value(values, "rx"), view.x, -1);
    ry = measures_.length(node, svg_value(values, "ry"), view.y, -1);
    if (rx < 0) rx = ry;
    if (ry < 0) ry = rx;
  }
  if (!(rx > 0) || !(ry > 0)) return {};
  const Vec2 center{measures_.length(node, svg_value(values, "cx"), view.x),
                    measures_.length(node, svg_value(values, "cy"), view.y)};
  Ring ring;
  append_arc({center, {rx, 0}, {0, ry}}, chords_per_turn_, ring);
  ring.pop_back();  // the last point repeats the first
  return ring;
}

Ring SvgShapes::rectangle(pugi::xml_node node, const SvgValues& values, const Vec2& view) const {
  const double x = measures_.length(node, svg_value(values, "x"), view.x),
               y = measures_.length(node, svg_value(values, "y"), view.y);
  const double w = measures_.length(node, svg_value(values, "width"), view.x),
               h = measures_.length(node, svg_value(values, "height"), view.y);
  if (!(w > 0) || !(h > 0)) return {};
  double rx = measures_.length(node, svg_value(values, "rx"), view.x, -1),
         ry = measures_.length(node, svg_value(values, "ry"), view.y, -1);
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
    append_arc({centers[static_cast<size_t>(n)], {rx, 0}, {0, ry}, (n - 1) * quarter, quarter}, chords_per_turn_, ring);
  return ring;
}

}  // namespace ombre::formats

#endif

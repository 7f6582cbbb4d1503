// The outlines of shapes of an SVG file. Only for builds with pugixml.
#pragma once

#include <optional>
#include <vector>

#include "base/math/polygons.h"
#include "formats/drawings/svg_measures.h"

namespace ombre::formats {

// Outlines in an element's own units.
struct SvgOutlines {
  std::vector<Ring> closed, open;
};

class SvgShapes {
 public:
  SvgShapes(const SvgMeasures& measures, int chords_per_turn)
      : measures_(measures), chords_per_turn_(chords_per_turn) {}

  // Returns the outlines of an element in a viewport of this size; null if it is no shape. Reports what is wrong with
  // the element, and throws DesignError.
  std::optional<SvgOutlines> outlines(pugi::xml_node node, const SvgValues& values, const Vec2& view) const;

 private:
  SvgOutlines path(pugi::xml_node node, const SvgValues& values) const;
  Ring points(pugi::xml_node node) const;
  Ring ellipse(pugi::xml_node node, const SvgValues& values, const Vec2& view, bool is_circle) const;
  Ring rectangle(pugi::xml_node node, const SvgValues& values, const Vec2& view) const;

  const SvgMeasures& measures_;
  int chords_per_turn_ = 0;
};

}  // namespace ombre::formats

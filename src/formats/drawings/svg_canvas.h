// Turns the outlines of an SVG file into areas and strokes. Only for builds with pugixml.
#pragma once

#include <string>
#include <vector>

#include "formats/drawings/svg_outlines.h"
#include "formats/drawings/svg_state.h"

namespace ombre::formats {

std::vector<Ring> mapped(const std::vector<Ring>& rings, const PlaneMap& map);

class SvgCanvas {
 public:
  SvgCanvas(const SvgMeasures& measures, const PlaneOptions& options) : measures_(measures), options_(options) {}

  // Adds the areas and strokes of an element to `shapes`: those of the drawing, or of a clip path.
  void draw(pugi::xml_node node, const SvgOutlines& outlines, const SvgValues& values, const SvgState& state,
            std::vector<PlaneShape>& shapes);

  // Counts a visible element that is no area.
  void leave_out(const std::string& kind, const SvgState& state);
  // Warns once of all that is left out, and notes how areas and strokes were chosen.
  void tell_left_out() const;

  // Returns the shapes that were drawn, and the counts of things that were left out.
  PlaneShapes& drawn() { return drawn_; }

 private:
  void add(PlaneShape shape, const SvgState& state, std::vector<PlaneShape>& shapes);
  PlaneStroke stroke(pugi::xml_node node, const SvgState& state) const;

  const SvgMeasures& measures_;
  const PlaneOptions& options_;
  PlaneShapes drawn_;
  size_t points_ = 0, unfilled_ = 0, borders_ = 0;
};

}  // namespace ombre::formats

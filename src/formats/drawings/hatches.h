// Parallel lines that fill polygons.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/vec.h"
#include "formats/drawings/outlines.h"

namespace ombre::formats {

struct HatchRule {
  double spacing_mm = 0.1;   // between lines
  double angle_degrees = 0;  // of the lines of the first layer, counter-clockwise from x
  double turn_degrees = 67;  // from one layer to the next
};

// A line that is drawn from its beginning to its end.
struct Hatch {
  Vec2 from, to;
};

// Returns the lines within the polygons of a region: those inside an odd number of them. Lines of all regions of a
// layer lie on the same rays, half a spacing from the origin and from there on, and go to and fro in turn.
std::vector<Hatch> hatches_of(const std::vector<std::vector<Vec2>>& polygons, const HatchRule& rule, int64_t layer);

}  // namespace ombre::formats

// Numbers that scripts read out of drawings.
#pragma once

#include <optional>
#include <string>

#include "base/vec.h"

namespace ombre::solids {

// Which drawing, and what is meant of it. Empty: any layer, any name. Places are moved by -origin, then scaled.
struct MeasureChoice {
  std::string path, layer, name;
  Vec2 origin;
  double scale = 1;
};

// What is found, or why it is not: a warning for the script.
template <class Value>
struct Measure {
  std::optional<Value> value;
  std::string warning;
};

// The first dimension of that name on that layer of a DXF file: mm, or degrees.
Measure<double> dimension_of(const MeasureChoice& choice);
// Where the first two lines of the layer cross.
Measure<Vec2> crossing_of(const MeasureChoice& choice);

}  // namespace ombre::solids

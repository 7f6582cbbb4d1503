// Numbers that scripts read out of drawings.
#pragma once

#include <optional>
#include <string>

#include "base/math/vec.h"

namespace ombre::solids {

// Chooses a drawing, and what is meant of it. Empty: any layer, any name. Places are moved by -origin, then scaled.
struct MeasureChoice {
  std::string path, layer, name;
  Vec2 origin;
  double scale = 1;
};

// A value, or the warning that says why there is none.
template <class Value>
struct Measure {
  std::optional<Value> value;
  std::string warning;
};

// The first dimension of that name on that layer of a DXF file: mm, or degrees.
Measure<double> dimension_of(const MeasureChoice& choice);
// The place where the first two lines of the layer cross.
Measure<Vec2> crossing_of(const MeasureChoice& choice);

}  // namespace ombre::solids

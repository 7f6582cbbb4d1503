// Numbers that scripts read from drawings.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/math/vec.h"

namespace ombre::solids {

// The choice of a drawing's measures. An empty layer or name matches any. Places are moved by -origin, then scaled.
struct MeasureChoice {
  std::string path, layer, name;
  std::string shown;  // the path in messages
  Vec2 origin;
  double scale = 1;
};

// A value, or a warning that says why there is none.
template <class Value>
struct Measure {
  std::optional<Value> value;
  std::string warning;
  std::map<std::string, size_t> others;  // how many entities of each kind are neither dimensions nor lines
};

// Returns the first dimension of that name on that layer of a DXF file, in mm or degrees.
Measure<double> dimension_of(const MeasureChoice& choice);
// Returns the intersection of the first two lines of the layer.
Measure<Vec2> crossing_of(const MeasureChoice& choice);

}  // namespace ombre::solids

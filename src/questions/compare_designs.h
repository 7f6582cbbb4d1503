// Finds where two designs of one shape give different values.
#pragma once

#include <optional>
#include <string>

#include "base/math/box.h"
#include "base/text/diagnostic.h"
#include "design/design.h"

namespace ombre::compile {

// The values that two designs give at a point, mm.
struct Difference {
  Vec3 at;
  std::string of;  // a material, for its fraction, or an attribute
  double first = 0, second = 0;
};

// Returns the greatest difference between the fractions of materials of two designs, or between their values of an
// attribute, at up to 64,000 points of the first one, evenly spaced in the box. `attribute` is empty for fractions.
// Returns nothing where they are equal, and where a design is too large, which adds diagnostics.
std::optional<Difference> greatest_difference(const design::Design& first, const design::Design& second,
                                              const std::string& attribute, const Box& box, Diagnostics& diagnostics);

}  // namespace ombre::compile

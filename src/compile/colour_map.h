// Values as colours.
#pragma once

#include <array>

#include "base/interval.h"
#include "design/materials.h"
#include "program/field.h"

namespace ombre::compile {

// From dark blue over green to yellow, even in lightness: nine colours of viridis (S. van der Walt and N. Smith, 2015),
// between which linear light is mixed. `share` goes from 0 to 1.
design::Rgba map_colour(double share);

// Linear red, green and blue of a value: the first colour up to range.lo, the last from range.hi on.
std::array<program::Field, 3> mapped_colour(program::Field value, Interval range);

}  // namespace ombre::compile

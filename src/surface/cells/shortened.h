// Programs as they are in a box.
#pragma once

#include <limits>

#include "base/math/box.h"
#include "program/program.h"

namespace ombre::surface {

constexpr size_t all_parts = std::numeric_limits<size_t>::max();

// The program for a box of points: what is settled there is left out, and many parts are written out, if fewer than
// `many` reach it.
program::Program shortened_for(const program::Program& details, const Box& box, size_t many = all_parts);

}  // namespace ombre::surface

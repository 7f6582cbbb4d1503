// Shortens programs for a box.
#pragma once

#include <limits>

#include "base/math/box.h"
#include "program/program.h"

namespace ombre::surface {

constexpr size_t all_parts = std::numeric_limits<size_t>::max();

// Returns a program equivalent to `details` inside the box, without the operations whose outcome is certain there.
// Loops over parts are unrolled if fewer than `many` parts reach the box.
program::Program shortened_for(const program::Program& details, const Box& box, size_t many = all_parts);

}  // namespace ombre::surface

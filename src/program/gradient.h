// Partial derivatives of fields, by rule.
#pragma once

#include <array>
#include <optional>

#include "program/field.h"

namespace ombre::program {

// By the point's x, y and z, of a field that was made at it, in the field's unit per mm. Nothing where there is no
// rule: for sources, bodies and parts, for powers whose exponents vary, and for what depends on space by another way
// than through the point's coordinates. Where a value bends or jumps the derivative is that of one side.
std::optional<std::array<Field, 3>> gradient(Field of, const Point& at);

}  // namespace ombre::program

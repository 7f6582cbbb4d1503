// Symbolic partial derivatives of fields.
#pragma once

#include <array>
#include <optional>

#include "program/field.h"

namespace ombre::program {

// Returns the derivatives of a field by the x, y and z of the point at which it was made, in the field's unit per mm.
// Returns nothing if there is no rule: for sources, bodies and parts, for powers with varying exponents, and for fields
// that depend on space in another way than through the point's coordinates. At a kink or jump the derivative is that of
// one side.
std::optional<std::array<Field, 3>> gradient(Field of, const Point& at);

}  // namespace ombre::program

// Operators on values in OpenSCAD. Undefined operations return undef and add a warning.
#pragma once

#include <string>
#include <vector>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

using Problems = std::vector<std::string>;  // texts of warnings; the caller adds the position

// Applies any operator except "&&" and "||", which do not evaluate both sides.
Value binary(ast::Operator op, const Value& left, const Value& right, Meter& meter, Problems& problems);
Value unary(ast::Operator op, const Value& operand, Meter& meter, Problems& problems);

}  // namespace ombre::lang::openscad

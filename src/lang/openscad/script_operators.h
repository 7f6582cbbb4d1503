// What operators do to values in OpenSCAD: where they have no meaning they give undef, and a warning says so.
#pragma once

#include <string>
#include <vector>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

using Problems = std::vector<std::string>;  // texts of warnings, whose place the caller knows

// All but "&&" and "||", which do not evaluate both sides.
Value binary(ast::Operator op, const Value& left, const Value& right, Meter& meter, Problems& problems);
Value unary(ast::Operator op, const Value& operand, Meter& meter, Problems& problems);
bool truth(const Value& value);

}  // namespace ombre::lang::openscad

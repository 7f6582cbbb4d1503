// Operators on values in OpenSCAD. Undefined operations return undef and add a warning.
#pragma once

#include <string>
#include <vector>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

// The text of a warning, or of an error. The caller adds the position, unless OpenSCAD gives none.
struct Problem {
  std::string text;
  bool has_place = true;
  bool is_error = false;  // the evaluation ends
};
using Problems = std::vector<Problem>;

// Applies any operator except "&&" and "||", which do not evaluate both sides.
Value binary(ast::Operator op, const Value& left, const Value& right, Meter& meter, Problems& problems);
Value unary(ast::Operator op, const Value& operand, Meter& meter, Problems& problems);

}  // namespace ombre::lang::openscad

// Operators on values.
#pragma once

#include <string>

#include "lang/engine/value.h"

namespace ombre::lang {

// Descriptions of two values that an operator does not accept. For nested lists these are the innermost values.
struct Mismatch {
  std::string left, right;  // `right` is empty for a unary operator
};

// Applies any operator except "&&" and "||", which do not evaluate both sides. Throws Mismatch.
Value apply(ast::Operator op, const Value& left, const Value& right, Meter& meter);
Value apply(ast::Operator op, const Value& operand, Meter& meter);

}  // namespace ombre::lang

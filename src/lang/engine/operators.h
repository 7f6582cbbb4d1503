// What operators do to values.
#pragma once

#include <string>

#include "lang/engine/value.h"

namespace ombre::lang {

// Two values that an operator does not take; of nested lists, the innermost ones.
struct Mismatch {
  std::string left, right;  // right is empty for an operator with one side
};

// All but "&&" and "||", which do not evaluate both sides. Throws Mismatch.
Value apply(ast::Operator op, const Value& left, const Value& right, Meter& meter);
Value apply(ast::Operator op, const Value& operand, Meter& meter);

}  // namespace ombre::lang

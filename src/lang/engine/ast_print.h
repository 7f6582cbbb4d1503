// Prints a script's tree as a script.
#pragma once

#include <string>

#include "lang/engine/ast.h"

namespace ombre::lang {

// The text reads back to the same tree: print(parse(print(f))) is print(f).
std::string print(const ast::File& file);
// One line, for messages.
std::string print(const ast::Expr& expression);

}  // namespace ombre::lang

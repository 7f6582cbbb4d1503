// Prints a syntax tree as a script.
#pragma once

#include <string>

#include "lang/engine/ast.h"

namespace ombre::lang {

// Returns a text that is parsed to the same tree: print(parse(print(f))) is print(f).
std::string print(const ast::File& file);
// Returns one line, for messages.
std::string print(const ast::Expr& expression);

}  // namespace ombre::lang

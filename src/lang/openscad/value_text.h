// Values and expressions as OpenSCAD writes them.
#pragma once

#include <string>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

// Six significant digits; decimal from 1e-5 to below 1e6, else with an exponent: 160000, 1.1e+6, 1e-7.
std::string number_text(double number);
// The same six digits as C++ streams write them: 1e+06, 1e-07. Nodes in .csg files have these.
std::string stream_text(double number);
// As str() and echo() write it; `quoted` is for strings inside of vectors, and for echo.
void append_value(std::string& text, const Value& value, bool quoted, Meter& meter);
std::string value_text(const Value& value, bool quoted, Meter& meter);
// "number", "string", "vector": in messages.
const char* type_name(const Value& value);

// With parentheses around every operator: "(x + 1)".
std::string expression_text(const ast::Expr& expression);
// The statements of a file, as `-o file.ast` holds them.
std::string scope_text(const ast::Plan& plan);

}  // namespace ombre::lang::openscad

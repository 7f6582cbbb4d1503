// Text of values and expressions, as OpenSCAD writes them.
#pragma once

#include <string>

#include "lang/engine/value.h"

namespace ombre::lang::openscad {

// Returns six significant digits, in decimal from 1e-5 to below 1e6, else with an exponent: 160000, 1.1e+6, 1e-7.
std::string number_text(double number);
// Returns six digits in the format of C++ streams (1e+06, 1e-07), which nodes in .csg files have.
std::string stream_text(double number);
// Returns literals that scripts read as the same value.
std::string literal_of(double number);
std::string literal_of(const std::string& text);
// Appends the text that str() and echo() print. `quoted` is set for strings in vectors, and for echo.
void append_value(std::string& text, const Value& value, bool quoted, Meter& meter);
std::string value_text(const Value& value, bool quoted, Meter& meter);
// Returns the type's name in messages: "number", "string", "vector".
const char* type_name(const Value& value);

// Returns the text with parentheses around every operator: "(x + 1)".
std::string expression_text(const ast::Expr& expression);
// Returns the statements of a file as in `-o file.ast`.
std::string scope_text(const ast::Plan& plan);

}  // namespace ombre::lang::openscad

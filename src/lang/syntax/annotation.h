// Comments of scripts in the form of OpenSCAD's customizer, which say what a variable or a parameter may be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/data.h"
#include "lang/syntax/ast.h"

namespace ombre::lang {

// The values that a comment allows.
struct Allowed {
  std::optional<double> least, step, most;            // limits of a number, or of each number of a vector
  std::vector<std::pair<Data, std::string>> choices;  // values and their labels
};

// Returns the value of an expression if it is plain: a number, text, truth value or vector of numbers.
std::optional<Data> plain_value(const ast::Expr& expr);

// Reads what stands in the brackets of [most], [least:most] or [least:step:most]. Returns false for all else.
bool read_range(std::string_view inside, Allowed& allowed);
// Reads what stands in the brackets of [a, b] or [1:small, 2:large]. With `is_text`, numbers are texts, too.
void read_choices(std::string_view inside, bool is_text, Allowed& allowed);

}  // namespace ombre::lang

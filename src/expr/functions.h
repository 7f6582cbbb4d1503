// The functions of expressions: their argument counts and what they become.
#pragma once

#include <span>
#include <string_view>

#include "program/field.h"

namespace ombre::expr {

struct Function {
  std::string_view name;
  int least, most;  // arguments; most -1: any number
  std::string_view arguments, meaning;
  program::Field (*lower)(std::span<const program::Field>);
};

std::span<const Function> functions();
const Function* find_function(std::string_view name);

}  // namespace ombre::expr

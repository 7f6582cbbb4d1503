// The functions of expressions: their numbers of arguments and how they are lowered to fields.
#pragma once

#include <span>
#include <string_view>

#include "program/field.h"

namespace ombre::expr {

struct Function {
  std::string_view name;
  int least, most;  // numbers of arguments; most is -1 if there is no limit
  std::string_view arguments, meaning;
  program::Field (*lower)(std::span<const program::Field>);
};

std::span<const Function> functions();
const Function* find_function(std::string_view name);

}  // namespace ombre::expr

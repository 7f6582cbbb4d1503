// The two languages that the engine reads. Both have OpenSCAD's grammar with small differences.
#pragma once

#include <cstdint>

namespace ombre::lang {

enum class Dialect : uint8_t {
  vcad,     // adds tuples, names with hyphens, calls without parentheses, a last statement without ";"
  openscad  // adds bit operators, hexadecimal numbers, names that begin with a digit, any backslash in strings
};

}  // namespace ombre::lang

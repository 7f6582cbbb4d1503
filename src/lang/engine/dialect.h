// The two languages that the engine reads. Their grammar is one, OpenSCAD's, with small differences.
#pragma once

#include <cstdint>

namespace ombre::lang {

enum class Dialect : uint8_t {
  vcad,     // tuples, names with hyphens, calls without parentheses, a last statement without ";"
  openscad  // bit operators, hexadecimal numbers, names that begin with a digit, any backslash in strings
};

}  // namespace ombre::lang

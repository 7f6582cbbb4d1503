// Elementary functions of rows of numbers: the bits of math.h, some at a time.
#pragma once

#include <cstddef>
#include <vector>

namespace ombre::math {

// out[n] = f(in[n]); both may be the same.
using RowFunction = void (*)(const double* in, double* out, size_t count);

#define OMBRE_ELEMENTARY_FUNCTIONS(F) \
  F(sin) F(cos) F(tan) F(asin) F(acos) F(atan) F(sinh) F(cosh) F(tanh) F(exp) F(log) F(log10) F(log2)

struct RowFunctions {
#define OMBRE_ROW_FUNCTION(name) RowFunction name;
  OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)
#undef OMBRE_ROW_FUNCTION
};

// For each instruction set that this processor has, the best first; all give the same.
const std::vector<RowFunctions>& row_functions();

}  // namespace ombre::math

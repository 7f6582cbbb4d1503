// Elementary functions of rows of numbers, vectorised; results are bit-identical to those of math.h.
#pragma once

#include <cstddef>
#include <vector>

namespace ombre::math {

// Computes out[n] = f(in[n]). `in` and `out` may be the same.
using RowFunction = void (*)(const double* in, double* out, size_t count);

#define OMBRE_ELEMENTARY_FUNCTIONS(F) \
  F(sin) F(cos) F(tan) F(asin) F(acos) F(atan) F(sinh) F(cosh) F(tanh) F(exp) F(log) F(log10) F(log2)

struct RowFunctions {
#define OMBRE_ROW_FUNCTION(name) RowFunction name;
  OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)
#undef OMBRE_ROW_FUNCTION
};

// Returns the functions for each instruction set of this processor, the fastest first. All give the same results.
const std::vector<RowFunctions>& row_functions();

}  // namespace ombre::math

// Elementary functions of rows of numbers, vectorised; results are bit-identical to those of math.h.
#pragma once

#include <cstddef>
#include <vector>

#include "base/math/elementary_functions.h"

namespace ombre::math {

// Computes out[n] = f(in[n]). `in` and `out` may be the same.
using RowFunction = void (*)(const double* in, double* out, size_t count);

struct RowFunctions {
#define OMBRE_ROW_FUNCTION(name) RowFunction name;
  OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)
#undef OMBRE_ROW_FUNCTION
};

// Returns the functions for each instruction set of this processor, the fastest first. All give the same results.
const std::vector<RowFunctions>& row_functions();

}  // namespace ombre::math

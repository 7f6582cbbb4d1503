// The elementary functions of one number.
#pragma once

#define OMBRE_ELEMENTARY_FUNCTIONS(F) \
  F(sin) F(cos) F(tan) F(asin) F(acos) F(atan) F(sinh) F(cosh) F(tanh) F(exp) F(log) F(log10) F(log2)

// Evaluates programs at single points, for tests.
#pragma once

#include "program/evaluate.h"

namespace ombre::program {

inline double value_at(const Program& program, Vec3 p, size_t output = 0) {
  std::vector<double> values;
  evaluate_point(program, p, values);
  return values[program.outputs[output]];
}

}  // namespace ombre::program

// Finds out which outputs of a program can be other than 0 within a box.
#pragma once

#include <vector>

#include "base/math/box.h"
#include "program/program.h"

namespace ombre::compile {

// Returns a flag for each output. The first output says where the others count, and is always possible. Another output
// is possible if a point is found where it is positive, or if intervals over ever smaller boxes do not exclude it
// within a bounded time. The result does not depend on the number of threads; 0 means all cores.
std::vector<bool> possible_outputs(const program::Program& program, const Box& box, int threads);

}  // namespace ombre::compile

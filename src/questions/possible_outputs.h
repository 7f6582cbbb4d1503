// Which outputs of a program can be other than 0 within a box.
#pragma once

#include <vector>

#include "base/math/box.h"
#include "program/program.h"

namespace ombre::compile {

// By output. The first one says where the others count, and is always among them. An output is possible where a point
// is found at which it is positive, and as long as intervals over ever smaller boxes do not exclude it, for a bounded
// time. The same with any number of threads, of which 0 means all.
std::vector<bool> possible_outputs(const program::Program& program, const Box& box, int threads);

}  // namespace ombre::compile

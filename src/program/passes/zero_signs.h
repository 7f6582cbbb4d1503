// Whether anything can tell +0 from -0.
#pragma once

#include <cstdint>
#include <vector>

#include "program/program.h"

namespace ombre::program {

// For each instruction: may the sign of its result, where that is 0, change an output by more than the sign of
// a 0? Only divisions by it, atan2 and powers of it tell.
std::vector<uint8_t> zero_signs_that_matter(const Program& program);

}  // namespace ombre::program

// Detection of instructions for which the sign of zero matters.
#pragma once

#include <cstdint>
#include <vector>

#include "program/program.h"

namespace ombre::program {

// Returns for each instruction whether the sign of a zero result can change an output by more than the sign of a zero.
// Only divisions by it, atan2 and its powers can do that.
std::vector<uint8_t> zero_signs_that_matter(const Program& program);

}  // namespace ombre::program

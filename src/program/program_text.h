// Programs as text, for people.
#pragma once

#include <string>

#include "program/program.h"

namespace ombre::program {

// One line an instruction with how often it is computed, then the outputs; bodies after the program
// that calls them.
std::string to_text(const Program& program);

}  // namespace ombre::program

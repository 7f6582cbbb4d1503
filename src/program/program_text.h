// Programs as text for people.
#pragma once

#include <string>

#include "program/program.h"

namespace ombre::program {

// Prints one line for each instruction, with how often it is computed, and the outputs. Bodies follow the program that
// calls them.
std::string to_text(const Program& program);

}  // namespace ombre::program

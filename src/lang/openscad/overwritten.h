// Variables that get several values in one scope, where the last one counts.
#pragma once

#include <vector>

#include "lang/engine/loader.h"
#include "lang/openscad/script_messages.h"

namespace ombre::lang::openscad {

// Messages in the order of the text. What stands in the main file from byte `definitions_from` on came from the command
// line, and may replace a value without a word.
std::vector<Message> overwritten(const Program& program, uint32_t definitions_from);

}  // namespace ombre::lang::openscad

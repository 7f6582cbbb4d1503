// Finds variables that get several values in one scope, of which the last counts.
#pragma once

#include <vector>

#include "lang/engine/loader.h"
#include "lang/openscad/script_messages.h"

namespace ombre::lang::openscad {

// Returns messages in the order of the text. Assignments in the main file from byte `definitions_from` on come from the
// command line, and replace values without a message.
std::vector<Message> overwritten(const Program& program, uint32_t definitions_from);

}  // namespace ombre::lang::openscad

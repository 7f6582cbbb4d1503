// Converts a script's messages to diagnostics of a design.
#pragma once

#include "lang/openscad/script_messages.h"

namespace ombre::lang::openscad {

// Adds diagnostics. Messages about the script itself get the positions of their lines; all others get `otherwise`, such
// as the call that runs the script.
void add_diagnostics(const Messages& messages, const SourcePtr& script, const SourceRange& otherwise,
                     Diagnostics& diagnostics);

}  // namespace ombre::lang::openscad

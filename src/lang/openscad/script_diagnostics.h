// A script's messages as diagnostics of a design.
#pragma once

#include "lang/openscad/script_messages.h"

namespace ombre::lang::openscad {

// Messages about the script itself have the places of their lines; `otherwise` is that of all others, such as the call
// that runs the script.
void add_diagnostics(const Messages& messages, const SourcePtr& script, const SourceRange& otherwise,
                     Diagnostics& diagnostics);

}  // namespace ombre::lang::openscad

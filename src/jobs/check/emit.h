// Prints intermediate forms of a design as text.
#pragma once

#include <string>
#include <vector>

#include "load/loaded.h"

namespace ombre::compile {

// Names of the forms: "ast", "tree", "program", "stats", "json", "passes" for a table of the passes that a program goes
// through before it slices, or "program=after-NAME" for the result of one of them.
const std::vector<std::string>& emit_forms();
std::string emit(const Loaded& loaded, const std::string& form);

}  // namespace ombre::compile

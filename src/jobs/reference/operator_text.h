// Prints the operators of libraries.
#pragma once

#include <string>
#include <vector>

#include "jobs/common/session.h"

namespace ombre::jobs {

// Prints a line for each operator, or sends its description as an event.
void list_operators(const Session& session);

// Explains an operator. Returns false if no library has it.
bool show_operator(const std::string& name, Session& session);

// Returns the names with those of all operators, for suggestions.
std::vector<std::string> names_with_operators(std::vector<std::string> names);

// Returns the page of the reference about the program's own operators.
std::string operators_reference();

}  // namespace ombre::jobs

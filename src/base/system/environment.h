// Variables of the environment, which nothing in this program changes.
#pragma once

#include <string>

namespace ombre {

// Returns the value of a variable, or an empty text if it is not set.
std::string environment(const char* name);

}  // namespace ombre

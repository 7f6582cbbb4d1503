// Names of the bodies that a script makes.
#pragma once

#include <string>

#include "solids/solid.h"

namespace ombre::lang::openscad {

// Returns the name of a body's part, else that of its material, else that of its colour, else an empty text.
std::string body_name(const solids::Attributes& attributes);

}  // namespace ombre::lang::openscad

// The content of a tree as text: equal content gives equal geometry.
#pragma once

#include "base/system/hash.h"
#include "solids/tree.h"

namespace ombre::solids {

// Returns the text of one operation with everything that decides its result, except its children and places in the
// script.
std::string text_of(const Tree& tree);

}  // namespace ombre::solids

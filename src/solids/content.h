// What a tree's content is: equal content gives equal geometry.
#pragma once

#include "base/system/hash.h"
#include "solids/tree.h"

namespace ombre::solids {

// Of one operation, with all that decides its result but its children. Places in the script do not count.
std::string text_of(const Tree& tree);

}  // namespace ombre::solids

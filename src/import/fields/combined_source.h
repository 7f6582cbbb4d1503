// Booleans of field sources with the channels "inside" and "distance".
#pragma once

#include <vector>

#include "program/field_source.h"

namespace ombre::importing {

// Any of them, at least one.
program::SourceField make_union_source(std::vector<program::SourceField> sources);

// What of a source lies inside of another, or outside.
program::SourceField make_clipped_source(program::SourceField source, program::SourceField by, bool keeps_inside);

}  // namespace ombre::importing

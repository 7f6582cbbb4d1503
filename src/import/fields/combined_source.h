// Booleans of field sources with the channels "inside" and "distance".
#pragma once

#include <vector>

#include "program/field_source.h"

namespace ombre::importing {

// Returns the union of at least one source.
program::SourceField make_union_source(std::vector<program::SourceField> sources);

// Returns the part of a source inside of another source, or outside of it.
program::SourceField make_clipped_source(program::SourceField source, program::SourceField by, bool keeps_inside);

}  // namespace ombre::importing

// Sets of voxels of a row, as spans.
#pragma once

#include <vector>

#include "program/field_source.h"

namespace ombre::importing {

using Spans = std::vector<program::Span>;  // in order, and apart from each other, unless said otherwise

// Puts spans in order, of which some may overlap or touch.
void unite(Spans& spans);
Spans intersection(const Spans& a, const Spans& b);
Spans difference(const Spans& a, const Spans& b);

}  // namespace ombre::importing

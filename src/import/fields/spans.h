// Sets of voxels of a row, as spans.
#pragma once

#include <vector>

#include "program/field_source.h"

namespace ombre::importing {

using Spans = std::vector<program::Span>;  // in ascending order and disjoint, unless stated otherwise

// Sorts spans and merges those that overlap or touch.
void unite(Spans& spans);
Spans intersection(const Spans& a, const Spans& b);
Spans difference(const Spans& a, const Spans& b);

}  // namespace ombre::importing

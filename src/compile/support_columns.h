// Upright stacks of cells on a grid, as a field source.
#pragma once

#include <vector>

#include "program/field_source.h"
#include "voxel/lattice.h"

namespace ombre::compile {

// Cells [bottom, top) of the column, which counts x first, then y.
struct Stack {
  uint32_t column = 0;
  int32_t bottom = 0, top = 0;
};

// Channels "inside" and "distance": of what is in a stack and in the box, to be exact up to one cell away. A column's
// stacks come in any order and do not meet.
program::SourceField make_columns(const voxel::Lattice& lattice, const Box& box, const std::vector<Stack>& stacks,
                                  Hash content);

}  // namespace ombre::compile

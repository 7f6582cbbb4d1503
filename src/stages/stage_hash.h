// Hashes everything that the values of a stage on its lattice are made from.
#pragma once

#include "stages/lattice_source.h"

namespace ombre::compile {

// Hashes the stage, its cells and all that it reads. If it reads only the shape of a solid, materials and attributes
// given to the solid as a whole do not count.
Hash hash_of_values(const LatticeFrame& frame);

}  // namespace ombre::compile

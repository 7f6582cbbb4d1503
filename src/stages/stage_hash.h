// What the values of a stage on its lattice are made from, as a hash.
#pragma once

#include "stages/lattice_source.h"

namespace ombre::compile {

// Of the stage, its cells and all that it reads. Where it reads nothing but the shape of a solid, materials and
// attributes that the solid was given as a whole do not count.
Hash hash_of_values(const LatticeFrame& frame, const design::MaterialTable& materials);

}  // namespace ombre::compile

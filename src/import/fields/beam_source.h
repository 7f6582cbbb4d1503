// Beam lattices as field sources.
#pragma once

#include <string>

#include "formats/mesh/mesh.h"
#include "program/field_source.h"

namespace ombre::importing {

// Returns the union of the beams and balls, in mm, without the lattice's clipping. Channels:
//   "inside"    1 inside, 0 outside. Its rows are exact.
//   "distance"  signed distance to the surface in mm, negative inside. Its magnitude may be too small inside, and
//               where the placement scales lengths unevenly.
program::SourceField make_beam_source(std::string name, const formats::PlacedLattice& placed, Hash content);

}  // namespace ombre::importing

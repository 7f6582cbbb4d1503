// Beam lattices as field sources.
#pragma once

#include <string>

#include "formats/mesh/mesh.h"
#include "program/field_source.h"

namespace ombre::importing {

// Beams and balls in mm, without their clipping. Channels:
//   "inside"    1 inside, 0 outside. Its rows are exact.
//   "distance"  mm to the surface, negative inside; it may be less than that inside, and where the placement stretches
//               lengths unevenly.
program::SourceField make_beam_source(std::string name, const formats::PlacedLattice& placed, Hash content);

}  // namespace ombre::importing

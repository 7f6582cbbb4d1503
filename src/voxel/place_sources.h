// Placement of a program's sources on the rows of a lattice.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "program/program.h"
#include "voxel/lattice.h"

namespace ombre::voxel {

// Samplers indexed by the tag of a read; null for sources that are evaluated at each point.
using RowSamplers = std::vector<std::unique_ptr<program::RowSampler>>;

// Sets the tags of the program's reads. Sources whose operands are affine in (x, y, z) are placed on the rows, each
// placement once. `program_from_index` maps indices of points to the program's (x, y, z).
RowSamplers place_sources(program::Program& program, const Affine& program_from_index);

// Places sources on rays. Operands must be affine in `base`, the three values of the program that are the depth and the
// position (right, down) at that depth.
RowSamplers place_sources(program::Program& program, const program::RayLattice& rays,
                          std::span<const program::ValueId> base);

// Returns the map from a voxel's index (i, j, k) to its centre.
Affine design_from_index(const Lattice& lattice);

}  // namespace ombre::voxel

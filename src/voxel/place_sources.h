// Sources of a program on the rows of a lattice of points.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "program/program.h"
#include "voxel/lattice.h"

namespace ombre::voxel {

// By the tag of a read; null for sources that are evaluated point by point.
using RowSamplers = std::vector<std::unique_ptr<program::RowSampler>>;

// Gives the program's reads their tags. Sources whose operands are affine in (x, y, z) are placed on the rows, each
// placement once. The map takes indices of points to the program's (x, y, z).
RowSamplers place_sources(program::Program& program, const Affine& program_from_index);

// The same on rays. Operands are affine in `base`: the values of the program that are the depth, and the place (right,
// down) at that depth.
RowSamplers place_sources(program::Program& program, const program::RayLattice& rays,
                          std::span<const program::ValueId> base);

// Index (i, j, k) of a voxel to its centre.
Affine design_from_index(const Lattice& lattice);

}  // namespace ombre::voxel

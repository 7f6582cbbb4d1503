// Finds formulas that repeat faster than voxels can show: periods below two voxels (Nyquist's limit).
#pragma once

#include <cstdint>
#include <optional>

#include "program/program.h"
#include "voxel/lattice.h"

namespace ombre::compile {

struct ShortPeriods {
  uint64_t places = 0;  // centres of voxels inside the solid that were looked at
  uint64_t found = 0;   // those where a period is too short
  Vec3 first_mm;        // the first of them, with the shortest period there and the axis along which it is so short
  int axis = 0;
  double period_mm = 0;
};

// Looks at sines, cosines, tangents and remainders of a program of materials, at places that are spread over the
// lattice. Their argument may not advance by more than half a period from the centre of a voxel to that of the next.
// Formulas that read files or stages are not looked at. The places depend on the lattice alone, and are at most a
// thousandth of its voxels.
ShortPeriods find_short_periods(const program::Program& program, const voxel::Lattice& lattice);

}  // namespace ombre::compile

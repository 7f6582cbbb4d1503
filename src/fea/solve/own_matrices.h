// The matrices of bricks that differ from that of a full brick.
#pragma once

#include <vector>

#include "fea/model/model.h"

namespace ombre::fea {

// Matrices, packed as in cut_brick.h; equal bricks share one.
struct OwnMatrices {
  std::vector<uint32_t> number;  // number of each brick's matrix, from 1; 0: that of a full brick. Empty: all are full
  std::vector<double> values;
  size_t size = 0;  // numbers in a matrix

  // Returns null for a full brick.
  const double* of(size_t brick) const {
    return number.empty() || number[brick] == 0 ? nullptr : values.data() + (number[brick] - 1) * size;
  }
};

// Makes the matrices of cut bricks and of bricks in walls that are fewer than `few_bricks` across, where a full brick
// would bend too little. There are none if the model's bricks have no fill.
OwnMatrices own_stiffness(const Model& model);
// Returns 1 for bricks that have such a matrix.
std::vector<uint8_t> bricks_with_own_stiffness(const Bricks& bricks);
// Makes the matrices of cut bricks, in W/(mm K) or S/mm; `per_mm` converts the sections' conductivities.
OwnMatrices own_conductance(const Bricks& bricks, const std::vector<Section>& sections,
                            const std::vector<uint16_t>& section_of, double per_mm);
// Returns a bound on the bytes of memory that a multigrid solution takes: matrices of cut bricks, and `node_bytes` and
// `brick_bytes` for each node and brick of all levels.
double multigrid_bytes(const Bricks& bricks, size_t unknowns, double node_bytes, double brick_bytes);

}  // namespace ombre::fea

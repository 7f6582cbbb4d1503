// The matrices of bricks that differ from a full brick's.
#pragma once

#include <vector>

#include "fea/model/model.h"

namespace ombre::fea {

// Equal bricks share a matrix, which is packed as in cut_brick.h.
struct OwnMatrices {
  std::vector<uint32_t> number;  // of each brick, from 1; 0: a full brick's. Empty: all are full
  std::vector<double> values;
  size_t size = 0;  // of a matrix, in numbers

  // Null for a full brick.
  const double* of(size_t brick) const {
    return number.empty() || number[brick] == 0 ? nullptr : values.data() + (number[brick] - 1) * size;
  }
};

// Of bricks that are cut, and those in walls that are fewer than `few_bricks` across, where a full brick would bend too
// little. None where the model's bricks have no fill.
OwnMatrices own_stiffness(const Model& model);
// 1 for bricks that have one of those.
std::vector<uint8_t> bricks_with_own_stiffness(const Bricks& bricks);
// Of bricks that are cut, W/(mm K) or S/mm for `per_mm` of the sections' conductivities.
OwnMatrices own_conductance(const Bricks& bricks, const std::vector<Section>& sections,
                            const std::vector<uint16_t>& section_of, double per_mm);
// The memory that they take at most.
double own_matrix_bytes(const Bricks& bricks, size_t unknowns);

}  // namespace ombre::fea

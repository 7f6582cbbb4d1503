// The stiffness and the conductance of a brick of which a part is inside a solid, or that lies in a thin wall.
#pragma once

#include <array>

#include "fea/model/fill.h"
#include "fea/solve/brick_stiffness.h"

namespace ombre::fea {

// Symmetric: the entries (row, column) up to the diagonal, row by row.
using PackedStiffness = std::array<double, 300>;
using PackedConductance = std::array<double, 36>;
inline constexpr size_t packed_place(size_t row, size_t column) {
  return row >= column ? row * (row + 1) / 2 + column : column * (column + 1) / 2 + row;
}

// Integrates over what is inside, part by part (finite cells: Parvizian, Duester and Rank, 2007). Nine strains that are
// linear along one axis come to those of the nodes, and leave no stress on average (enhanced strains: Simo and Rifai,
// 1990), so that a brick bends as a beam does, whatever part of its height is filled. The change of volume is without
// its terms of the second degree, so that nearly incompressible materials do not lock.
PackedStiffness cut_stiffness(Vec3 size_mm, Fill fill, double shear_mpa, double bulk_mpa);

// The strains that come to those of the nodes in such a brick.
class EnhancedStrains {
 public:
  EnhancedStrains(Vec3 size_mm, Fill fill, double shear_mpa, double bulk_mpa);

  // xx, yy, zz, xy, yz, zx at a place, whose coordinates go from 0 to 1 in the brick, for displacements of its nodes.
  std::array<double, 6> at(const BrickVector& displacements, Vec3 place) const;

 private:
  std::array<BrickVector, 9> by_displacement_{};
  Vec3 means_;  // of the coordinates of FillMoments over what is inside
};

// For a conductivity of one.
PackedConductance cut_conductance(Vec3 size_mm, Fill fill);

}  // namespace ombre::fea

// The stiffness and the conductance of a brick that is partly inside a solid, or lies in a thin wall.
#pragma once

#include <array>

#include "fea/model/fill.h"
#include "fea/solve/brick_stiffness.h"

namespace ombre::fea {

// A symmetric matrix: the entries (row, column) up to the diagonal, row by row.
using PackedStiffness = std::array<double, 300>;
using PackedConductance = std::array<double, 36>;
inline constexpr size_t packed_place(size_t row, size_t column) {
  return row >= column ? row * (row + 1) / 2 + column : column * (column + 1) / 2 + row;
}

// Integrates over the parts inside (finite cells: Parvizian, Duester and Rank, 2007). Nine strains that are linear
// along one axis are added to those of the nodes; they have no stress on average (enhanced strains: Simo and Rifai,
// 1990). So a brick bends as a beam does, whatever part of its height is filled. The change of volume has no terms of
// the second degree, so that nearly incompressible materials do not lock.
PackedStiffness cut_stiffness(Vec3 size_mm, Fill fill, double shear_mpa, double bulk_mpa);

// The enhanced strains of such a brick, which are added to those of the nodes.
class EnhancedStrains {
 public:
  EnhancedStrains(Vec3 size_mm, Fill fill, double shear_mpa, double bulk_mpa);

  // Returns xx, yy, zz, xy, yz, zx at a place, whose coordinates go from 0 to 1 in the brick, for displacements of its
  // nodes.
  std::array<double, 6> at(const BrickVector& displacements, Vec3 place) const;

 private:
  std::array<BrickVector, 9> by_displacement_{};
  Vec3 means_;  // means of the coordinates of FillMoments over the part inside
};

// Returns the conductance for a conductivity of one.
PackedConductance cut_conductance(Vec3 size_mm, Fill fill);

}  // namespace ombre::fea

// Periodic cells: which nodes are copies of others, and what a mean strain means for them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fea/model/element_mesh.h"

namespace ombre::fea {

// A node that is a copy of another, and its distance from it in periods along each axis. The other node is not a copy
// itself.
struct Tie {
  uint32_t node = 0, of = 0;
  std::array<int, 3> periods{};
  bool operator==(const Tie&) const = default;
};

// A mesh that fits its copies node by node, with their mean strain: xx, yy, zz, xy, yz, zx, the last three as twice the
// tensor's.
struct Repeat {
  Vec3 period_mm;
  std::vector<Tie> ties;  // in ascending order of nodes
  std::array<double, 6> mean_strain{};

  // Returns the difference of displacements over a period along the axis, by the mean strain.
  Vec3 displacement_mm(int axis) const;
};

// Returns the mean stress, MPa, over a period, void included, of elements with these stresses.
std::array<double, 6> mean_stress(const MeshView& mesh, const std::vector<std::array<double, 6>>& stress_mpa,
                                  Vec3 period_mm);

// Finds nodes whose places differ by whole periods, up to a millionth of them. The first of equal nodes is not a copy.
std::vector<Tie> ties_of(const MeshView& mesh, Vec3 period_mm);

}  // namespace ombre::fea

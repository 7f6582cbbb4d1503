// Cells that repeat: which nodes are copies of others, and what a mean strain means for them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fea/model/element_mesh.h"

namespace ombre::fea {

// The node lies so many periods along each axis from the node that it is a copy of, which is no copy itself.
struct Tie {
  uint32_t node = 0, of = 0;
  std::array<int, 3> periods{};
  bool operator==(const Tie&) const = default;
};

// A mesh that fits its copies node by node, and the mean strain of all of them: xx, yy, zz, xy, yz, zx, the last three
// as twice the tensor's.
struct Repeat {
  Vec3 period_mm;
  std::vector<Tie> ties;  // in ascending order of nodes
  std::array<double, 6> mean_strain{};

  // How far the mean strain moves what lies a period along the axis away.
  Vec3 displacement_mm(int axis) const;
};

// The mean stress over a period, void included, of elements with these stresses; MPa.
std::array<double, 6> mean_stress(const MeshView& mesh, const std::vector<std::array<double, 6>>& stress_mpa,
                                  Vec3 period_mm);

// Nodes whose places differ by whole periods, up to a millionth of them: the first one is no copy.
std::vector<Tie> ties_of(const MeshView& mesh, Vec3 period_mm);

}  // namespace ombre::fea

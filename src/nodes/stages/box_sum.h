// Sums of a solid's materials over boxes of voxels, as a stage.
#pragma once

#include "design/stage.h"

namespace ombre::nodes {

inline constexpr MaterialId void_material = 0;

// The box around a voxel has so many along x, y and z; of an even number, one more lies below the voxel than above.
struct BoxSums {
  std::array<int, 3> size{3, 3, 3};
  bool count_void = false;  // what is outside of the solid counts as void, else not at all
  std::optional<Vec3> cell_mm;
};

// Gives each material a channel of the name that sum_channel() says: the sum of its fractions, in voxels.
design::StagePtr make_box_sums(const design::NodePtr& solid, const BoxSums& use);
std::string sum_channel(MaterialId material);

}  // namespace ombre::nodes

// A stage with sums of a solid's materials over boxes of voxels.
#pragma once

#include "design/stage.h"

namespace ombre::nodes {

inline constexpr MaterialId void_material = 0;

// The size of the box around a voxel along x, y and z. If it is even, one more voxel lies below than above.
struct BoxSums {
  std::array<int, 3> size{3, 3, 3};
  bool count_void = false;  // counts the outside of the solid as void; else it does not count
  std::optional<Vec3> cell_mm;
};

// Makes a stage with a channel for each material, named by sum_channel(): the sum of its fractions, in voxels.
design::StagePtr make_box_sums(const design::NodePtr& solid, const BoxSums& use);
std::string sum_channel(MaterialId material);

}  // namespace ombre::nodes

// Stages that filter a solid's voxels: materials, attributes, and the inside.
#pragma once

#include <functional>

#include "design/stage.h"
#include "nodes/common/linear_filter.h"

namespace ombre::nodes {

// The values of a solid that are filtered, and the size of the cells.
struct FilterUse {
  bool materials = true;
  bool count_void = false;              // counts the outside of the solid as void; else it does not count
  std::vector<std::string> attributes;  // names of attributes that are numbers
  std::optional<Vec3> cell_mm;
};

// Makes a stage of weighted sums. Its channels are sum_channel() of each material, with sums of its fractions; "share",
// the sum over voxels inside; and for each attribute the sum over voxels inside.
design::StagePtr make_linear_stage(const design::NodePtr& solid, const FilterUse& use, const std::string& key,
                                   std::function<LinearFilter(Vec3 cell_mm)> filter);

// Makes a stage in which the most frequent material in the box around each voxel has fraction 1 and all others 0. In a
// tie the voxel's own material wins, then the first in the table.
design::StagePtr make_majority_stage(const design::NodePtr& solid, const FilterUse& use, const design::Counts3& size);
// Makes a stage of medians: the middle one of each attribute's values at the voxels inside, in the box around each
// voxel. For an even number of values it is the lower of the two middle ones. The channel "share" is 1 if a voxel of
// the box is inside.
design::StagePtr make_median_stage(const design::NodePtr& solid, const FilterUse& use, const design::Counts3& size);

enum class Morphology : uint8_t { dilate, erode, opening, closing };
// Makes a stage with the flag "inside". Dilation adds the voxels of a ball around each voxel inside; erosion keeps the
// voxels whose ball lies inside; opening and closing do both in turn. A ball contains the voxels whose centres are at
// most `radius_mm` away.
design::StagePtr make_morphology_stage(const design::NodePtr& solid, Morphology what, double radius_mm,
                                       const std::optional<Vec3>& cell_mm);

}  // namespace ombre::nodes

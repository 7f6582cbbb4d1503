// Stages that filter a solid's voxels: their materials, their attributes, and whether they are inside.
#pragma once

#include <functional>

#include "design/stage.h"
#include "nodes/common/linear_filter.h"

namespace ombre::nodes {

// What of a solid is filtered, and in which cells.
struct FilterUse {
  bool materials = true;
  bool count_void = false;              // what is outside of the solid counts as void, else not at all
  std::vector<std::string> attributes;  // numbers
  std::optional<Vec3> cell_mm;
};

// Channels: sum_channel() of each material, weighted sums of its fractions; "share", the weighted sum of voxels inside;
// and each attribute's weighted sum over the voxels inside.
design::StagePtr make_linear_stage(const design::NodePtr& solid, const FilterUse& use, const std::string& key,
                                   std::function<LinearFilter(Vec3 cell_mm)> filter);

// In the box around each voxel, the material with most of it counts as 1 and others as 0; among equals the voxel's own,
// then the first in the table.
design::StagePtr make_majority_stage(const design::NodePtr& solid, const FilterUse& use, const design::Counts3& size);
// The middle one of each attribute's values at the voxels inside in the box around each voxel; of an even number, the
// lower of the two. "share" is 1 where some voxel of the box is inside.
design::StagePtr make_median_stage(const design::NodePtr& solid, const FilterUse& use, const design::Counts3& size);

enum class Morphology : uint8_t { dilate, erode, opening, closing };
// The mark "inside": voxels of a ball around a voxel inside (dilate), or whose ball lies inside (erode), or both after
// another. A ball holds the voxels whose centres are at most `radius_mm` away.
design::StagePtr make_morphology_stage(const design::NodePtr& solid, Morphology what, double radius_mm,
                                       const std::optional<Vec3>& cell_mm);

}  // namespace ombre::nodes

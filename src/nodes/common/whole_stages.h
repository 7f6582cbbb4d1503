// Stages that read all voxels of a solid at once.
#pragma once

#include <functional>

#include "design/stage.h"
#include "nodes/common/linear_filter.h"

namespace ombre::nodes {

enum class KeepParts : uint8_t { largest, above, at };

struct PartChoice {
  KeepParts keep = KeepParts::largest;
  double least_mm3 = 0;  // of the parts kept by `above`
  std::vector<Vec3> at;  // points of the parts kept by `at`
};

// The mark "inside": of the parts of a solid whose voxels touch by their sides, those that are chosen. Of equally large
// ones the one that comes first, from the lowest layer up, is the largest.
design::StagePtr make_parts_stage(const design::NodePtr& solid, const PartChoice& choice,
                                  const std::optional<Vec3>& cell_mm);

// The mark "inside": the solid, and the hollows in it of at most so many mm3 that are closed by sides of voxels.
design::StagePtr make_fill_stage(const design::NodePtr& solid, double most_mm3, const std::optional<Vec3>& cell_mm);

// The channel "sdf": the distance (mm) to where the solid's values, linear between voxels, change their sign; negative
// inside. Each voxel takes the nearest of the points that its neighbours know of (Y. Tsai, Rapid and accurate
// computation of the distance function using grids, 2002). The mark "known": 1 where that is known.
design::StagePtr make_distance_stage(const design::NodePtr& solid, const std::optional<Vec3>& cell_mm,
                                     double margin_mm);

// Beyond the solid's box by how much its smoothed surface may move, and in which cells it is found.
struct KeptVolumeUse {
  double margin_mm = 0;
  std::optional<Vec3> cell_mm;
};

// The channel "share": the filter's weighted sum of voxels inside, moved by a number, so that as many voxels have 1/2
// or more as are inside of the solid (but for voxels that have the same sum). Weights are not negative, and `key` says
// what they are.
design::StagePtr make_kept_volume_stage(const design::NodePtr& solid, const KeptVolumeUse& use, const std::string& key,
                                        std::function<LinearFilter(Vec3 cell_mm)> filter);

}  // namespace ombre::nodes

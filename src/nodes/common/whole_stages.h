// Stages that read all voxels of a solid at once.
#pragma once

#include <functional>

#include "design/stage.h"
#include "nodes/common/linear_filter.h"

namespace ombre::nodes {

enum class KeepParts : uint8_t { largest, above, at };

struct PartChoice {
  KeepParts keep = KeepParts::largest;
  double least_mm3 = 0;  // least volume of the parts that `above` keeps
  std::vector<Vec3> at;  // points in the parts that `at` keeps
};

// Makes a stage with the flag "inside", set for the chosen parts of a solid. Voxels that share a side belong to the
// same part. Of parts with equal volume, the first one from the lowest layer up counts as larger.
design::StagePtr make_parts_stage(const design::NodePtr& solid, const PartChoice& choice,
                                  const std::optional<Vec3>& cell_mm);

// Makes a stage with the flag "inside", set for the solid and for its hollows of at most `most_mm3` that are closed by
// sides of voxels.
design::StagePtr make_fill_stage(const design::NodePtr& solid, double most_mm3, const std::optional<Vec3>& cell_mm);

// Makes a stage of distances. The channel "sdf" is the signed distance (mm) to the surface where the solid's values,
// interpolated linearly between voxels, change sign. It is found by passing nearest points from voxel to voxel (Y.
// Tsai, Rapid and accurate computation of the distance function using grids, 2002). The flag "known" is 1 where the
// distance is known.
design::StagePtr make_distance_stage(const design::NodePtr& solid, const std::optional<Vec3>& cell_mm,
                                     double margin_mm);

// The margin by which the smoothed surface may extend beyond the solid's box, and the size of the cells.
struct KeptVolumeUse {
  double margin_mm = 0;
  std::optional<Vec3> cell_mm;
};

// Makes a stage that smooths a solid and keeps its volume. The channel "share" is the filter's weighted sum of voxels
// inside plus a constant, chosen so that the number of voxels with 1/2 or more equals that of the voxels inside the
// solid (except for equal sums). Weights must not be negative; `key` identifies them.
design::StagePtr make_kept_volume_stage(const design::NodePtr& solid, const KeptVolumeUse& use, const std::string& key,
                                        std::function<LinearFilter(Vec3 cell_mm)> filter);

}  // namespace ombre::nodes

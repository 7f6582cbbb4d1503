// Finds the voxels of a job at which attributes have values beyond a reach.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "base/system/progress.h"
#include "base/text/diagnostic.h"
#include "design/design.h"
#include "voxel/lattice.h"

namespace ombre::compile {

struct AttributeReach {
  std::string attribute;
  Interval reach;
};

struct OutOfReach {
  uint64_t voxels = 0;
  // The value that is farthest beyond the reach, and the centre of the first voxel that has it, mm.
  double worst = 0;
  Vec3 worst_mm;
};

// Returns what lies beyond each of the reaches within the design, by more than rounding (1e-9 of their ends); values
// that are no numbers lie nowhere. Intervals
// settle boxes of voxels, and the others are evaluated voxel by voxel in double precision. The design's stages, if it
// has any, must be prepared. Returns nothing, and adds diagnostics, if a program would be too large. Throws Cancelled.
std::optional<std::vector<OutOfReach>> survey_reach(const design::Design& design, const voxel::Lattice& lattice,
                                                    const std::vector<AttributeReach>& reaches, int threads,
                                                    const StopFlag* stop, Diagnostics& diagnostics);

}  // namespace ombre::compile

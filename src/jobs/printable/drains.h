// Channels that let liquid or powder out of closed hollows.
#pragma once

#include "jobs/printable/print_checks.h"
#include "jobs/printable/voxel_changes.h"

namespace ombre::compile {

struct DrainRules {
  double diameter_mm = 0;
  MaterialId support = 0;  // counts as void, since it is removed after printing
};

struct Drains {
  VoxelChanges changes;  // solid voxels that become void
  uint64_t opened = 0;   // hollows
  uint64_t left = 0;     // hollows from which no straight line along an axis leads outside, but through other hollows
};

// Opens each closed hollow by one straight channel along x, y or z. Of the shortest places, nearest to the middle of
// the hollow, that one is taken whose channel removes least; of equal ones the first, by axis, z, y and x. The channel
// is where a ball of the diameter passes that moves from one side of the wall to the other. Hollows within hollows need
// another call. Takes memory for the runs of void.
Drains open_hollows(const Plan& plan, const DrainRules& rules, const CheckRun& run);

}  // namespace ombre::compile

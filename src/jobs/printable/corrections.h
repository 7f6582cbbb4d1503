// Changes of voxels that correct what checks find, where one correction is well defined.
#pragma once

#include "jobs/printable/print_checks.h"
#include "jobs/printable/voxel_changes.h"

namespace ombre::compile {

// Removes bodies whose volume is below a limit, but not the largest body. Voxels of the support material belong to no
// body. Takes memory for the runs of such bodies.
VoxelChanges drop_loose_bodies(const Plan& plan, double below_mm3, MaterialId support, const CheckRun& run);

// Thickens walls and details that are thinner than the limit. Wherever thin_places() finds one, the largest ball that
// the place holds grows to the diameter of the limit about its middle, so that the place has that thickness, and
// nothing thin is left. What is added has the material of the nearest voxel. If the job may not grow, nothing is added
// outside its lattice.
VoxelChanges thicken(const Plan& plan, double limit_mm, bool may_grow, const CheckRun& run);

// Gives the voxels that checks of neighbours find a material that no rule names: a shell between the two.
VoxelChanges keep_apart(const Plan& plan, const std::vector<PrintCheck>& checks, MaterialId neutral,
                        const CheckRun& run);

}  // namespace ombre::compile

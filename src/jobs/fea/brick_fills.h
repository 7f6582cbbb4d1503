// How much of each brick of a lattice is inside a design.
#pragma once

#include <optional>
#include <vector>

#include "fea/model/bricks.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

struct FilledBrick {
  fea::Cell cell{};
  fea::Fill fill = 0;
  MaterialId drawn = 0;  // the material of a part near the centre
  Vec3 place;            // that is inside, and near the middle of what is inside; mm
};

// A plan on the lattice of the parts of these bricks.
std::optional<Plan> plan_parts(const LoadedPtr& loaded, PlanOptions options, const voxel::Lattice& bricks,
                               Diagnostics& diagnostics);

struct FilledBricks {
  std::vector<FilledBrick> bricks;  // of which at least fea::least_fill is inside, in the order of their cells
  double filled_count = 0;          // how many full ones have the volume of all that is inside
};

// Each part of those near the surface
// goes by one point, which lie at different heights along each axis, so that a plane cuts off its volume to a 64th part
// of the brick. Nothing, and diagnostics, when the design cannot be sampled. Throws Cancelled.
std::optional<FilledBricks> fill_bricks(const design::Design& design, const LoadedPtr& loaded, const Plan& parts,
                                        int threads, Diagnostics& diagnostics, const StopFlag* stop);

}  // namespace ombre::compile

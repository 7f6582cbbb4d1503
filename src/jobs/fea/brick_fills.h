// Finds how much of each brick of a lattice is inside a design.
#pragma once

#include <optional>
#include <vector>

#include "fea/model/bricks.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

struct FilledBrick {
  fea::Cell cell{};
  fea::Fill fill = 0;
  MaterialId drawn = 0;  // material of a part near the centre
  Vec3 place;            // a place inside, near the centroid of the part inside; mm
};

// Makes a plan on the lattice of the parts of these bricks.
std::optional<Plan> plan_parts(const LoadedPtr& loaded, PlanOptions options, const voxel::Lattice& bricks,
                               Diagnostics& diagnostics);

struct FilledBricks {
  std::vector<FilledBrick> bricks;  // bricks of which at least fea::least_fill is inside, in the order of their cells
  double filled_count = 0;          // number of full bricks with the volume of everything inside
};

// Fills the bricks. A part near the surface is sampled at one point. The points of a brick lie at different heights
// along each axis, so a plane cuts off its volume to a 64th part of the brick. Returns nothing, and adds diagnostics,
// when the design cannot be sampled. Throws Cancelled.
std::optional<FilledBricks> fill_bricks(const design::Design& design, const LoadedPtr& loaded, const Plan& parts,
                                        int threads, Diagnostics& diagnostics, const StopFlag* stop);

}  // namespace ombre::compile

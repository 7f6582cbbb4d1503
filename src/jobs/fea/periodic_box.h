// Finds the periodic cell by which a design is homogenised.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "base/math/box.h"
#include "jobs/fea/fea_job.h"

namespace ombre::compile {

// A box of a design, cut into bricks. Their counts are of the form m * 2^k with m up to 7, so that the solver can join
// them two by two.
struct PeriodicBox {
  Box box;  // mm
  std::array<int32_t, 3> count{};
};

// Cuts the box into bricks of about `cell_mm` along each edge. Without a box it takes that of the design; returns
// nothing, and adds a diagnostic, if that is unbounded or has no size.
std::optional<PeriodicBox> periodic_box(const LoadedPtr& loaded, const std::optional<Box>& box, double cell_mm,
                                        Diagnostics& diagnostics);

// Returns the design, sampled in that box by voxels that are its bricks.
LoadedPtr sampled_by(const LoadedPtr& loaded, const PeriodicBox& box);

// Returns a model of such a design, made by `fea_model`, whose bricks repeat after the box.
fea::Model repeating(fea::Model model, const PeriodicBox& box, const StopFlag* stop = nullptr);

}  // namespace ombre::compile

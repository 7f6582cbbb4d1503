// The periodic cell that a design is homogenised by.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "base/math/box.h"
#include "jobs/fea/fea_job.h"

namespace ombre::compile {

// A box of a design, cut into bricks, whose counts are of the form m * 2^k with m up to 7, so that the solver can join
// them two by two.
struct PeriodicBox {
  Box box;  // mm
  std::array<int32_t, 3> count{};
};

// About `cell_mm` along each edge. Without a box that of the design is meant; nothing, and a diagnostic, where it has
// no end or no size.
std::optional<PeriodicBox> periodic_box(const LoadedPtr& loaded, const std::optional<Box>& box, double cell_mm,
                                        Diagnostics& diagnostics);

// The same design, sampled in that box by voxels that are its bricks.
LoadedPtr sampled_by(const LoadedPtr& loaded, const PeriodicBox& box);

// A model by `fea_model` of such a design, whose bricks repeat after the box.
fea::Model repeating(fea::Model model, const PeriodicBox& box, const StopFlag* stop = nullptr);

}  // namespace ombre::compile

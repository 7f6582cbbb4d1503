// Vertices moved so that the regions keep their volumes.
#pragma once

#include <optional>

#include "surface/cells/partition.h"
#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

// What moved from where.
class VolumeFit {
 public:
  // Along curved borders facets enclose too much or too little: vertices lie where they are nearest to planes. What
  // lies between each facet and the border is measured, and the vertices and clusters around it move along the border's
  // normal until they have made up for it. Those on lines where borders meet stay, as do those where more than two
  // regions do. The border is looked for within `reach_mm`. Throws Cancelled.
  VolumeFit(QuadSurface& surface, const Partition& partition, double reach_mm, const Workers& workers);

  // Moves what stands at the corners of these quads back; false when nothing there had moved.
  bool undo(QuadSurface& surface, const std::vector<uint32_t>& quads);

 private:
  std::vector<std::optional<Vec3>> from_;  // by cluster
};

}  // namespace ombre::surface

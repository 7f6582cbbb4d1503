// Moves vertices so that the regions keep their volumes.
#pragma once

#include <optional>

#include "surface/cells/partition.h"
#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

// A correction of volumes that remembers the former places of the clusters it moved.
class VolumeFit {
 public:
  // Facets along curved borders enclose too much or too little volume, because vertices lie nearest to planes. The
  // constructor measures the volume between each facet and the border, and moves the vertices and clusters around it
  // along the border's normal to compensate. Vertices on lines where borders or more than two regions meet stay. The
  // border is searched for within `reach_mm`. Throws Cancelled.
  VolumeFit(QuadSurface& surface, const Partition& partition, double reach_mm, const Workers& workers);

  // Moves the clusters at the corners of these quads back. Returns false if none of them had moved.
  bool undo(QuadSurface& surface, const std::vector<uint32_t>& quads);

 private:
  std::vector<std::optional<Vec3>> from_;  // by cluster: its former place, if it moved
};

}  // namespace ombre::surface

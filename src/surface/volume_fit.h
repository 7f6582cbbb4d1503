// Vertices of smooth borders moved so that the regions keep their volumes.
#pragma once

#include <optional>

#include "surface/partition.h"
#include "surface/quad_surface.h"

namespace ombre::surface {

// What moved from where.
class VolumeFit {
 public:
  // On a curved border the point nearest to the planes around it lies off the border, on its outer side: half as far as
  // from the middle of the crossings. Facets between such points enclose too much where each stands for a cell, and too
  // little where they stand for many. Vertices and clusters between two regions move to where the volume is right;
  // those that lie on the border itself, as on edges and corners, stay. Throws Cancelled.
  VolumeFit(QuadSurface& surface, const Partition& partition, int threads, const StopFlag* stop);

  // Moves what stands at the corners of these quads back; false when nothing there had moved.
  bool undo(QuadSurface& surface, const std::vector<uint32_t>& quads);

 private:
  std::vector<std::optional<Vec3>> from_;  // by cluster
};

}  // namespace ombre::surface

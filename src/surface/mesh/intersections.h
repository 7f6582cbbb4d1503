// Finds intersecting facets.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "surface/mesh/quad_surface.h"
#include "surface/mesh/seen_quads.h"

namespace ombre::surface {

// Pairs of numbers of quads, the lower first; both are equal if the two triangles of one quad intersect.
using QuadPairs = std::vector<std::pair<uint32_t, uint32_t>>;

class IntersectionFinder {
 public:
  explicit IntersectionFinder(const Workers& workers) : workers_(workers) {}

  // Returns, in order, the quads of pairs of triangles of which a side of one passes through the other, or which share
  // a side and are folded onto each other. Touching triangles do not count. Checks only pairs of which one changed
  // since the last call.
  QuadPairs find(const QuadSurface& surface);
  // Updates the numbers of quads after a subdivision renumbered the crossings.
  void renumber(const std::vector<Crossing>& crossings) { clean_.renumber(crossings); }

 private:
  Workers workers_;
  SeenQuads clean_;
};

}  // namespace ombre::surface

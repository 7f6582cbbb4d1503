// Facets that go through each other.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "surface/mesh/quad_surface.h"
#include "surface/mesh/seen_quads.h"

namespace ombre::surface {

// Numbers of quads, lower first, one twice if its triangles lie upon each other.
using QuadPairs = std::vector<std::pair<uint32_t, uint32_t>>;

class IntersectionFinder {
 public:
  explicit IntersectionFinder(const Workers& workers) : workers_(workers) {}

  // Pairs of triangles of which a side of one pierces the other, or that have a common side and lie upon each other; in
  // order. Triangles that only touch do not count. Checks only pairs of which one changed since the last time.
  QuadPairs find(const QuadSurface& surface);
  // After a cut the quads around crossings have other numbers.
  void renumber(const std::vector<Crossing>& crossings) { clean_.renumber(crossings); }

 private:
  Workers workers_;
  SeenQuads clean_;
};

}  // namespace ombre::surface

// The dual mesh at full resolution: a vertex for each part of a leaf, a quad around each crossed edge.
#pragma once

#include <array>
#include <vector>

#include "surface/cells/crossings.h"
#include "surface/cells/quadric.h"
#include "surface/cells/workers.h"
#include "surface/mesh/normal_spread.h"

namespace ombre::surface {

struct DualVertex {
  uint32_t leaf = 0;
  bool parts_two = false;  // exactly two regions meet there
  Quadric planes;
  NormalSpread spread;  // of normals from lesser into greater labels
  Vec3 at;              // mm; where it is nearest to the planes, as far as there is room
};

// Around the edge of a crossing, counter-clockwise as seen from region `front`. Corner n lies in the leaf where the
// edge has offsets quad_offsets[n]; corners in a leaf that is larger than its edge are there twice.
struct DualQuad {
  uint32_t crossing = 0;
  std::array<uint32_t, 4> corners{};
};

struct DualMesh {
  std::vector<DualVertex> vertices;  // in order of their leaves
  std::vector<DualQuad> quads;
};

// Throws Cancelled.
DualMesh make_dual_mesh(const CellTree& tree, const std::vector<Crossing>& crossings, const Workers& workers);

// The same after the tree grew from `before`. `leaves` are the numbers that leaves have now.
DualMesh make_dual_mesh_after_growth(const CellTree& tree, const std::vector<Crossing>& crossings,
                                     const DualMesh& before, const std::vector<uint32_t>& leaves,
                                     const Workers& workers);

}  // namespace ombre::surface

// The dual mesh at full resolution: one vertex for each part of a leaf, one quad around each crossed edge.
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
  bool parts_two = false;  // true if exactly two regions meet there
  Quadric planes;
  NormalSpread spread;  // spread of the normals, each from the lesser into the greater label
  Vec3 at;              // point nearest to the planes inside the room around its cell, mm
};

// The quad around the edge of a crossing, counter-clockwise as seen from region `front`. Corner n is a vertex of the
// leaf in which the edge has offsets quad_offsets[n]; a leaf larger than the edge supplies two corners.
struct DualQuad {
  uint32_t crossing = 0;
  std::array<uint32_t, 4> corners{};
};

struct DualMesh {
  std::vector<DualVertex> vertices;  // in the order of their leaves
  std::vector<DualQuad> quads;
};

// Makes the dual mesh of a tree. Throws Cancelled.
DualMesh make_dual_mesh(const CellTree& tree, const std::vector<Crossing>& crossings, const Workers& workers);

// Makes the dual mesh after the tree grew, and reuses vertices of `before`. `leaves` maps old numbers of leaves to new
// ones. Throws Cancelled.
DualMesh make_dual_mesh_after_growth(const CellTree& tree, const std::vector<Crossing>& crossings,
                                     const DualMesh& before, const std::vector<uint32_t>& leaves,
                                     const Workers& workers);

}  // namespace ombre::surface

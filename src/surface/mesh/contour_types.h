// What contouring takes and gives.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/cells/partition.h"
#include "surface/cells/workers.h"
#include "voxel/lattice.h"

namespace ombre::surface {

// Counter-clockwise as seen from region `front`; region `back` is behind it. 0 is void.
struct Facet {
  std::array<uint32_t, 3> corners{};
  Label back = 0, front = 0;
};

// What is thinner than the cells and missing from a surface.
struct LostParts {
  uint64_t places = 0;  // corners of cells that have it beside them
  Vec3 first;           // mm, one of the places
};

struct ContourReport {
  uint64_t at_mean_points = 0;        // vertices that would have folded the surface
  uint64_t folded = 0;                // triangles that still look against the surface there
  uint64_t intersections = 0;         // pairs of triangles that still go through each other
  double farthest_in_tolerances = 1;  // from the borders, or these from the triangles, at samples; at least 1
  LostParts lost;
};

// Facets between any two regions; those around one region enclose it without a gap.
struct RegionSurface {
  std::vector<Vec3> vertices;  // mm
  std::vector<Facet> facets;
  ContourReport report;
};

struct ContourOptions {
  voxel::Lattice corners;   // the cells' corners; its outermost points count as void
  double tolerance_mm = 0;  // cells are cut where the surface would lie farther off; at least 0
  bool join_flat = true;    // flat cells are joined within the tolerance
  Workers workers;
  size_t memory_bytes = 0;  // 0: no limit; else fewer cells are cut, and grids that are too large throw Error
};

}  // namespace ombre::surface

// Options and results of contouring.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "surface/cells/partition.h"
#include "surface/cells/workers.h"
#include "voxel/lattice.h"

namespace ombre::surface {

// A triangle between two regions, counter-clockwise as seen from region `front`; region `back` lies behind it. Region 0
// is void.
struct Facet {
  std::array<uint32_t, 3> corners{};
  Label back = 0, front = 0;
};

// Parts of a design that are thinner than the cells and missing from a surface.
struct LostParts {
  uint64_t places = 0;  // number of corners of cells next to such parts
  Vec3 first;           // mm, one of the places
};

struct ContourReport {
  uint64_t at_mean_points = 0;  // vertices moved to mean points, because they would have folded the surface
  uint64_t folded = 0;          // triangles that still face the wrong way there
  uint64_t intersections = 0;   // pairs of triangles that still intersect
  // greatest distance at the samples between the borders and the triangles, in tolerances; at least 1
  double farthest_in_tolerances = 1;
  LostParts lost;
};

// Facets between pairs of regions; the facets around one region form a closed surface.
struct RegionSurface {
  std::vector<Vec3> vertices;  // mm
  std::vector<Facet> facets;
  ContourReport report;
};

struct ContourOptions {
  voxel::Lattice corners;   // corners of the cells; the outermost ones count as void
  double tolerance_mm = 0;  // cells are subdivided where the surface would be farther off; at least 0
  bool join_flat = true;    // whether flat cells are joined within the tolerance
  Workers workers;
  // limit on memory; 0: none. Fewer cells are subdivided if necessary, and grids that are too large throw Error.
  size_t memory_bytes = 0;
};

}  // namespace ombre::surface

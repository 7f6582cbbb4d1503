// Tetrahedra that fill a solid, by a library in a separate module.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/math/box.h"
#include "base/system/progress.h"

namespace ombre::solids {

using Polyline = std::vector<Vec3>;

struct TetrahedraRequest {
  Box box;  // contains the solid with a margin, or is the periodic cell, a cube
  // True if the mesh is periodic in the box. Some tetrahedra then extend beyond the box on one side and leave matching
  // gaps on the opposite side, so that the mesh fits its copies node by node. Sharp edges and fixed points are not
  // kept.
  bool is_periodic = false;
  // Returns the number of the region at a point, from 1; 0 is outside. Its exceptions are passed on.
  std::function<uint32_t(Vec3)> region;
  std::function<double(Vec3)> size_mm;  // returns the wanted length of edges at a point
  double least_size_mm = 0;             // least value of size_mm
  // Sharp edges of the surface, which become edges of tetrahedra. Their first and last points are corners.
  std::vector<Polyline> sharp_edges;
  // Points of the surface that become nodes; needed for closed surfaces without sharp edges, which are not found
  // otherwise.
  std::vector<Vec3> fixed_points;
  double distance_share = 0.05;  // greatest distance of faces from the surface, in sizes
  // After so many queries of `region`, the mesher drops the sharp edges at which refinement does not come to an end.
  uint64_t most_questions = 10'000'000;
  size_t memory_bytes = size_t{8} << 30;  // memory limit of the mesher
  const StopFlag* stop = nullptr;         // may be null
};

// A tetrahedral mesh. Nodes are ordered by z, then y, then x; tetrahedra are ordered by their nodes. All have positive
// volume: seen from the fourth node, the first three are counter-clockwise.
struct Tetrahedra {
  std::vector<Vec3> points;  // mm
  std::vector<std::array<uint32_t, 4>> nodes;
  std::vector<uint32_t> regions;         // by tetrahedron: number of its region
  std::vector<Polyline> edges_left_out;  // the dropped sharp edges, which lie too close to others for the size
};

// Makes tetrahedra by Delaunay refinement of the volume (CGAL's Mesh_3, after Rineau and Yvinec, 2007; sharp edges
// after Cheng, Dey and Levine, 2007), then removes slivers by moving nodes and by weights. It runs on one thread, so
// that equal requests give equal results. It runs in a separate process, because edges that cross each other crash the
// library; `region` and `size_mm` run there too, and must not use other threads. Throws Error if this build has no such
// library or it fails, and Cancelled.
Tetrahedra make_tetrahedra(const TetrahedraRequest& request);
bool has_tetrahedra();

}  // namespace ombre::solids

// Makes tetrahedra; the function that the module exports.
extern "C" void ombre_make_tetrahedra(const ombre::solids::TetrahedraRequest& request, ombre::solids::Tetrahedra& made);

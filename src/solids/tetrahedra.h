// Tetrahedra that fill a solid, by a library that lies in a module of its own.
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
  Box box;  // holds the solid, with some room around it; or the cell that repeats, a cube
  // The mesh repeats after the box: it is made of tetrahedra of which some reach out of it on one side and leave as
  // much room on the other, so that it fits its copies node by node. Sharp edges and fixed points are not kept.
  bool is_periodic = false;
  // The number of the region at a point, from 1; 0 is outside. What it throws goes through.
  std::function<uint32_t(Vec3)> region;
  std::function<double(Vec3)> size_mm;  // the wanted length of edges at a point
  double least_size_mm = 0;             // that size_mm gives anywhere
  // Sharp edges of the surface, which become edges of tetrahedra. The first and last points are corners.
  std::vector<Polyline> sharp_edges;
  // Points of the surface that become nodes, for closed surfaces without sharp edges, which are not found otherwise.
  std::vector<Vec3> fixed_points;
  double distance_share = 0.05;  // how far faces may lie from the surface, in sizes
  // How often `region` may be queried until sharp edges are left out, with which refinement does not end.
  uint64_t most_questions = 10'000'000;
  size_t memory_bytes = size_t{8} << 30;  // most that the mesher may take
  const StopFlag* stop = nullptr;         // may be null
};

// Nodes come in ascending order of z, then y, then x; tetrahedra in that of their nodes. All are positive: seen from
// the fourth node, the first three turn counter-clockwise.
struct Tetrahedra {
  std::vector<Vec3> points;  // mm
  std::vector<std::array<uint32_t, 4>> nodes;
  std::vector<uint32_t> regions;         // of each tetrahedron
  std::vector<Polyline> edges_left_out;  // sharp edges that lie too close to others for the size: cut off
};

// Delaunay refinement of the volume (CGAL's Mesh_3, after Rineau and Yvinec, 2007; sharp edges after Cheng, Dey and
// Levine, 2007), then slivers are removed by moves of nodes and by weights. On one thread, so that the same request
// gives the same bits; in a process of its own, since edges that cross each other crash it: `region` and `size_mm` run
// there, and must not use other threads. Throws Error where there is no such library in this build, or it fails, and
// Cancelled.
Tetrahedra make_tetrahedra(const TetrahedraRequest& request);
bool has_tetrahedra();

}  // namespace ombre::solids

// The function that the module exports.
extern "C" void ombre_make_tetrahedra(const ombre::solids::TetrahedraRequest& request, ombre::solids::Tetrahedra& made);

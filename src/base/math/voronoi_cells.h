// The Voronoi cells of points as polyhedra.
#pragma once

#include "base/math/point_sets.h"

namespace ombre {

// The part of space that is nearer to a point than to the others.
struct VoronoiCell {
  bool is_bounded = false;  // false of cells that extend to infinity, of which nothing else is known
  bool is_inner = false;    // it has no face in common with such a cell
  double volume_mm3 = 0;
  size_t faces = 0, edges = 0;
  double edges_mm = 0;  // length of all its edges
  Box box;              // around its corners

  size_t corners() const { return edges + 2 - faces; }  // by Euler's formula
};

// Returns the cell of each point, in their order. Corners are the centres of the circumspheres of Delaunay's
// tetrahedra.
OfPoints<VoronoiCell> voronoi_cells(std::span<const Vec3> points);

}  // namespace ombre

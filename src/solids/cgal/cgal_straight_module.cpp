// Removes corners at which a surface is flat or has a straight edge, where booleans have cut triangles of planes.
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <vector>

#include "solids/cgal/cgal_body.h"

namespace ombre::solids {
namespace {

using Vertex = ExactMesh::Vertex_index;
using Side = ExactMesh::Halfedge_index;

class Straightener {
 public:
  explicit Straightener(ExactMesh& mesh) : mesh_(mesh) {}

  // Corners are visited again after a neighbour is gone, since that may leave them straight.
  void run() {
    std::vector<Vertex> open(mesh_.vertices().begin(), mesh_.vertices().end());
    while (!open.empty()) {
      std::vector<Vertex> near;
      for (const Vertex vertex : open)
        if (!mesh_.is_removed(vertex) && !mesh_.is_isolated(vertex)) remove(vertex, near);
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      open = std::move(near);
    }
    if (mesh_.has_garbage()) mesh_.collect_garbage();
  }

 private:
  const Exact::Point_3& point(Vertex vertex) const { return mesh_.point(vertex); }

  bool is_flat(Side side) const {
    const Side other = mesh_.opposite(side);
    return CGAL::coplanar(point(mesh_.source(side)), point(mesh_.target(side)), point(mesh_.target(mesh_.next(side))),
                          point(mesh_.target(mesh_.next(other))));
  }

  // Returns the sides that end at the vertex.
  std::vector<Side> sides_at(Vertex vertex) const {
    std::vector<Side> sides;
    for (const Side side : mesh_.halfedges_around_target(mesh_.halfedge(vertex))) sides.push_back(side);
    return sides;
  }

  // Removes the vertex, if it is straight, and adds its neighbours to `near`.
  void remove(Vertex vertex, std::vector<Vertex>& near) {
    const std::vector<Side> sides = sides_at(vertex);
    std::vector<Side> edges;  // at which the surface is bent
    for (const Side side : sides) {
      if (is_flat(side)) continue;
      edges.push_back(side);
      if (edges.size() > 2) return;
    }
    if (edges.size() == 1) return;
    if (edges.size() == 2 &&
        !CGAL::collinear(point(mesh_.source(edges[0])), point(vertex), point(mesh_.source(edges[1]))))
      return;
    for (const Side side : edges.empty() ? sides : edges) {
      if (!can_move_along(side, sides)) continue;
      for (const Side other : sides) near.push_back(mesh_.source(other));
      const Exact::Point_3 end = point(mesh_.source(side));
      near.push_back(CGAL::Euler::collapse_edge(mesh_.edge(side), mesh_));
      mesh_.point(near.back()) = end;
      return;
    }
  }

  // Returns true if the triangles around the target of the side keep their orientation when it moves to the source.
  bool can_move_along(Side side, const std::vector<Side>& sides) const {
    if (!CGAL::Euler::does_satisfy_link_condition(mesh_.edge(side), mesh_)) return false;
    const Vertex end = mesh_.source(side);
    return std::all_of(sides.begin(), sides.end(), [&](Side other) {
      const Vertex a = mesh_.source(other), b = mesh_.target(mesh_.next(other));
      return a == end || b == end || keeps_side(point(a), point(mesh_.target(other)), point(b), point(end));
    });
  }

  // Returns true if `end` lies in the plane of a, corner and b, on the same side of the line a-b as the corner.
  static bool keeps_side(const Exact::Point_3& a, const Exact::Point_3& corner, const Exact::Point_3& b,
                         const Exact::Point_3& end) {
    return CGAL::coplanar(a, corner, b, end) && !CGAL::collinear(a, b, end) && !CGAL::collinear(a, b, corner) &&
           CGAL::coplanar_orientation(a, b, corner, end) == CGAL::POSITIVE;
  }

  ExactMesh& mesh_;
};

}  // namespace

ExactMesh without_straight_corners(ExactMesh mesh) {
  Straightener(mesh).run();
  return mesh;
}

}  // namespace ombre::solids

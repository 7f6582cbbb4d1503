// Bodies as CGAL has them: surface meshes with exact coordinates.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "solids/kernel.h"

namespace ombre::solids {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;

// Closed surfaces, each free of touching and crossing itself; what they hold has no common inside, but they may touch
// each other. Most bodies have one. A surface may have several shells.
class CgalBody : public Body {
 public:
  // Coordinates are evaluated, so that bodies can be read by several threads and forget how they were made.
  explicit CgalBody(std::vector<ExactMesh> parts);

  TriangleMesh mesh() const override;
  const Box& bounds() const override { return bounds_; }
  const std::vector<ExactMesh>& parts() const { return parts_; }

 private:
  std::vector<ExactMesh> parts_;
  Box bounds_;
};

inline const CgalBody& cgal(const Body& body) { return static_cast<const CgalBody&>(body); }

Box box_of(const ExactMesh& mesh);
// The result's surfaces, by Nef polyhedra: slow, but where they touch themselves that is no obstacle.
std::vector<ExactMesh> combine_nef(Boolean operation, const ExactMesh& a, const ExactMesh& b);
std::vector<TriangleMesh> convex_parts_nef(const ExactMesh& mesh);
TriangleMesh hull_of(std::span<const Vec3> points);
PlaneTriangles triangulate_rings(std::span<const Ring> rings);
// The surface of triangles; where more than two share an edge, those that bound the same sector of the solid stay
// joined, so that solids touch along it.
ExactMesh mesh_of_soup(std::vector<Exact::Point_3> points, std::vector<std::vector<std::size_t>> polygons);
// Shells that touch each other as surfaces of their own, each with the cavities that lie in it.
std::vector<ExactMesh> apart(const ExactMesh& mesh);

}  // namespace ombre::solids

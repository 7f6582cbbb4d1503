// Bodies as CGAL has them: surface meshes with exact coordinates.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <memory>
#include <utility>
#include <vector>

#include "solids/kernel.h"

namespace ombre::solids {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;

class NefSolid;  // a Nef polyhedron

// A closed surface that does not cross itself, perhaps of several shells. Where it touches itself it has coinciding
// vertices, which surface meshes cannot tell from others: then booleans use the solid beside it.
struct Part {
  Part() = default;
  Part(ExactMesh mesh) : surface(std::move(mesh)) {}  // NOLINT: a surface alone is a part
  Part(ExactMesh mesh, std::shared_ptr<const NefSolid> solid) : surface(std::move(mesh)), nef(std::move(solid)) {}

  ExactMesh surface;
  std::shared_ptr<const NefSolid> nef;  // null: the surface does not touch itself
};
using Parts = std::vector<Part>;

// The insides of parts do not overlap, but they may touch each other. Most bodies have one.
class CgalBody : public Body {
 public:
  // Coordinates are evaluated, so that bodies can be read by several threads and forget how they were made.
  explicit CgalBody(Parts parts);

  TriangleMesh mesh() const override;
  const Box& bounds() const override { return bounds_; }
  const Parts& parts() const { return parts_; }

 private:
  Parts parts_;
  Box bounds_;
};

inline const CgalBody& cgal(const Body& body) { return static_cast<const CgalBody&>(body); }

Box box_of(const ExactMesh& mesh);
// Whether vertices coincide.
bool touches_itself(const ExactMesh& mesh);
// The result's surfaces, by Nef polyhedra: slow, but where they touch themselves that is no obstacle.
Parts combine_nef(Boolean operation, const Part& a, const Part& b);
std::vector<TriangleMesh> convex_parts_nef(const Part& part);
Part moved_nef(const Part& part, const CGAL::Aff_transformation_3<Exact>& map);
TriangleMesh hull_of(std::span<const Vec3> points);
PlaneTriangles triangulate_rings(std::span<const Ring> rings);
// The surface of triangles; where more than two share an edge, those that bound the same sector of the solid stay
// joined, so that solids touch along it.
ExactMesh mesh_of_soup(std::vector<Exact::Point_3> points, std::vector<std::vector<std::size_t>> polygons);
// Shells that touch each other as surfaces of their own, each with the cavities that lie in it.
std::vector<ExactMesh> apart(const ExactMesh& mesh);

}  // namespace ombre::solids

// Bodies in the form of CGAL: surface meshes with exact coordinates.
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

// A closed surface without self-intersections, of one or more shells. Where it touches itself it has coinciding
// vertices, which a surface mesh treats as different; then booleans use `nef` instead.
struct Part {
  Part() = default;
  Part(ExactMesh mesh) : surface(std::move(mesh)) {}  // NOLINT: a surface alone is a part
  Part(ExactMesh mesh, std::shared_ptr<const NefSolid> solid) : surface(std::move(mesh)), nef(std::move(solid)) {}

  ExactMesh surface;
  std::shared_ptr<const NefSolid> nef;  // null if the surface does not touch itself
};
using Parts = std::vector<Part>;

// A body of parts whose interiors do not overlap, but which may touch each other. Most bodies have one part.
class CgalBody : public Body {
 public:
  // Evaluates all coordinates, so that several threads can read the body and the history of lazy numbers is freed.
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
// Returns true if vertices coincide.
bool touches_itself(const ExactMesh& mesh);
// Returns the angle about the line a-b from c to d in half turns: 0 for none, 1 for less than half a turn, 2 for half a
// turn, 3 for more.
int part_of_turn(const Exact::Point_3& a, const Exact::Point_3& b, const Exact::Point_3& c, const Exact::Point_3& d);
// Returns true if the result of the boolean would touch itself along an edge that the surfaces have in common.
bool touches_itself_after(Boolean operation, const ExactMesh& first, const ExactMesh& second);
// Combines parts by Nef polyhedra. This is slow, but surfaces may touch themselves.
Parts combine_nef(Boolean operation, const Part& a, const Part& b);
// Returns the solid of all points with a winding number other than 0 in a closed mesh that may cross itself.
Parts wound_parts(const TriangleMesh& mesh);
std::vector<TriangleMesh> convex_parts_nef(const Part& part);
// Returns the part of a surface that touches itself.
Part touching_part(ExactMesh surface);
Part moved_nef(const Part& part, const CGAL::Aff_transformation_3<Exact>& map);
TriangleMesh hull_of(std::span<const Vec3> points);
PlaneTriangles triangulate_rings(std::span<const Ring> rings);
TriangleMesh roof_over(std::span<const Ring> rings);
// Returns the surface mesh of triangles. Where more than two share an edge, those that bound the same sector of the
// solid stay joined, so that solids touch along it.
ExactMesh mesh_of_soup(std::vector<Exact::Point_3> points, std::vector<std::vector<std::size_t>> polygons);
// Separates shells that touch each other; each result is an outer shell with its cavities.
std::vector<ExactMesh> apart(const ExactMesh& mesh);

}  // namespace ombre::solids

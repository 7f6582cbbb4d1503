// What a geometry kernel does for solids. Its library lies in a module that is loaded when it is first needed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/math/polygons.h"
#include "solids/triangle_mesh.h"

namespace ombre::solids {

// A closed polyhedron with exact coordinates, in the kernel's own form. Immutable.
class Body {
 public:
  virtual ~Body() = default;
  virtual TriangleMesh mesh() const = 0;  // rounded to doubles
  virtual const Box& bounds() const = 0;  // may be wider by the last bit
};

enum class Boolean { unite, intersect, subtract };

// Corners are numbers of points: those of the rings, ring after ring, where the first of equal ones counts, then those
// where rings cross.
struct PlaneTriangles {
  std::vector<Vec2> crossings;
  std::vector<Triangle> triangles;
};

// Thread-safe. Bodies may be empty. What fails throws Error.
class Kernel {
 public:
  virtual ~Kernel() = default;
  // Of a closed mesh without repeated points. What is not trusted is also checked for crossing itself, and turned so
  // that its inside is inside: `remark` then says what was done.
  virtual BodyPtr body(const TriangleMesh& mesh, bool is_trusted, std::string& remark) const = 0;
  virtual BodyPtr moved(const Body& body, const Affine& map) const = 0;
  virtual BodyPtr combine(Boolean operation, const Body& a, const Body& b) const = 0;
  // Of bodies whose boxes do not meet: their union.
  virtual BodyPtr gathered(std::span<const BodyPtr> bodies) const = 0;
  // The convex hull; empty where the points lie in a plane.
  virtual TriangleMesh hull(std::span<const Vec3> points) const = 0;
  virtual bool is_convex(const Body& body) const = 0;
  // Convex pieces whose union is the body.
  virtual std::vector<TriangleMesh> convex_parts(const Body& body) const = 0;
  // Triangles between the points of rings, counter-clockwise; inside is what an odd number of rings goes round.
  virtual PlaneTriangles triangulate(std::span<const Ring> rings) const = 0;
};

// The one of this build. Throws Error when there is none.
const Kernel& kernel();
bool has_kernel();
std::string without_kernel();  // what a person reads then

}  // namespace ombre::solids

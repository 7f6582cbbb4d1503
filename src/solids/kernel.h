// The interface of a geometry kernel. Its library is in a module that is loaded on first use.
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
  virtual TriangleMesh mesh() const = 0;  // with coordinates rounded to doubles
  virtual const Box& bounds() const = 0;  // may be larger by a rounding error
};

enum class Boolean { unite, intersect, subtract };

// A triangulation. Corners are numbers of points: first those of the rings, ring after ring, where the first of equal
// points counts; then those where rings cross.
struct PlaneTriangles {
  std::vector<Vec2> crossings;
  std::vector<Triangle> triangles;
};

// A geometry kernel. Thread-safe. Bodies may be empty. Failures throw Error.
class Kernel {
 public:
  virtual ~Kernel() = default;
  // Returns the body of a closed mesh without repeated points. An untrusted mesh is also checked for self-intersections
  // and turned outward; `remark` then says what was changed.
  virtual BodyPtr body(const TriangleMesh& mesh, bool is_trusted, std::string& remark) const = 0;
  // Returns the body of all points with a winding number other than 0 in a closed mesh that may cross itself.
  virtual BodyPtr wound(const TriangleMesh& mesh) const = 0;
  virtual BodyPtr moved(const Body& body, const Affine& map) const = 0;
  virtual BodyPtr combine(Boolean operation, const Body& a, const Body& b) const = 0;
  // Returns the union of bodies whose boxes do not meet.
  virtual BodyPtr gathered(std::span<const BodyPtr> bodies) const = 0;
  // Returns the convex hull, which is empty if the points lie in a plane.
  virtual TriangleMesh hull(std::span<const Vec3> points) const = 0;
  virtual bool is_convex(const Body& body) const = 0;
  // Returns convex pieces whose union is the body.
  virtual std::vector<TriangleMesh> convex_parts(const Body& body) const = 0;
  // Returns triangles between the points of rings, counter-clockwise; a point is inside if an odd number of rings
  // encloses it.
  virtual PlaneTriangles triangulate(std::span<const Ring> rings) const = 0;
  // Returns planes that rise at 45 degrees inward from the sides of rings, up to where they meet. Outlines are
  // counter-clockwise, holes clockwise, and rings neither cross nor touch. The first points are those of the rings.
  virtual TriangleMesh roof(std::span<const Ring> rings) const = 0;
};

// Returns the kernel of this build. Throws Error if there is none.
const Kernel& kernel();
bool has_kernel();
std::string without_kernel();  // the message for builds without a kernel

}  // namespace ombre::solids

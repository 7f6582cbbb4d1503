// What evaluating a tree of geometry gives: closed solids and plane regions with their attributes. Millimetres.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/box.h"
#include "base/polygons.h"
#include "solids/tree.h"

namespace ombre::solids {

using Triangle = std::array<uint32_t, 3>;

// Triangles are counter-clockwise when seen from outside.
struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

Box bounds_of(const TriangleMesh& mesh);
// Of a closed mesh, mm3; negative where it is inside out.
double volume_of(const TriangleMesh& mesh);
// The image under a map with a determinant other than 0; mirrored triangles are turned round.
TriangleMesh moved(const TriangleMesh& mesh, const Affine& map);

// Equal points become one, points that no triangle uses go, and so do triangles with fewer than three corners.
TriangleMesh tidied(const TriangleMesh& mesh);

// The same surface with its points and triangles in an order that their coordinates decide.
TriangleMesh sorted(const TriangleMesh& mesh);

class Body;  // of a geometry kernel, with exact coordinates
using BodyPtr = std::shared_ptr<const Body>;

// A closed polyhedron, which may consist of several pieces and have cavities. Immutable, cheap to copy, thread-safe.
// It is given as a mesh or as a body of the kernel, and converted to the other when that is needed.
class Solid {
 public:
  explicit Solid(TriangleMesh mesh);
  explicit Solid(BodyPtr body);

  bool is_empty() const { return bounds().is_empty(); }
  const Box& bounds() const;
  // Coordinates of a body are rounded to doubles.
  const TriangleMesh& mesh() const;
  // Throws Error where the mesh is not closed or crosses itself, and when this was built without a kernel.
  const BodyPtr& body() const;
  bool is_exact() const;  // is there a body already?

 private:
  struct State;
  std::shared_ptr<State> state_;
};

// A region of the plane z = 0: outlines counter-clockwise, holes clockwise, none of which cross.
struct Region {
  std::vector<Ring> rings;
  bool is_empty() const { return rings.empty(); }
};

double area_of(const Region& region);
Box bounds_of(const Region& region);  // flat

struct Attributes {
  std::string material, part;  // empty: none
  std::optional<Colour> colour;
  bool operator==(const Attributes&) const = default;
};

// One solid or region. An empty one stands where an operation left nothing, so that operators above know of it.
struct Piece {
  Attributes attributes;
  std::variant<std::monostate, Solid, Region> shape;

  int dimension() const { return static_cast<int>(shape.index() == 0 ? 0 : shape.index() == 1 ? 3 : 2); }
  const Solid* solid() const { return std::get_if<Solid>(&shape); }
  const Region* region() const { return std::get_if<Region>(&shape); }
};
using Pieces = std::vector<Piece>;

}  // namespace ombre::solids

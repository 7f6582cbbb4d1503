// What evaluating a tree of geometry gives: closed solids and plane regions with their attributes. Millimetres.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/math/box.h"
#include "base/math/polygons.h"
#include "solids/tree.h"
#include "solids/triangle_mesh.h"

namespace ombre::solids {

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

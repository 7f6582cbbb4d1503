// Results of evaluating a tree of geometry: closed solids and plane regions with their attributes. Lengths are in
// millimetres.
#pragma once

#include <cstdint>
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

// A known fault of a mesh that people gave.
enum class Flaw : uint8_t { none, crosses, open };

// A closed polyhedron, which may consist of several pieces and have cavities. Immutable, cheap to copy, thread-safe. It
// is constructed from a mesh or from a body of the kernel, and converted to the other on demand.
class Solid {
 public:
  // If the mesh crosses itself, its body is all points with a winding number other than 0.
  explicit Solid(TriangleMesh mesh, Flaw flaw = Flaw::none);
  explicit Solid(BodyPtr body);

  bool is_empty() const { return bounds().is_empty(); }
  const Box& bounds() const;
  // Returns the mesh; a body's coordinates are rounded to doubles.
  const TriangleMesh& mesh() const;
  // Returns the body. Throws Error if the mesh is not closed, and in builds without a kernel.
  const BodyPtr& body() const;
  bool is_exact() const;  // true if there is already a body
  Flaw flaw() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

// A region of the plane z = 0: outlines are counter-clockwise, holes clockwise, and no two cross.
struct Region {
  std::vector<Ring> rings;
  bool is_empty() const { return rings.empty(); }
};

double area_of(const Region& region);
Box bounds_of(const Region& region);  // with z = 0

struct Attributes {
  std::string material, part;  // empty: none
  std::optional<Colour> colour;
  bool operator==(const Attributes&) const = default;
};

// One solid or region. An empty piece marks that an operation had no result, so that operations above it know.
struct Piece {
  Attributes attributes;
  std::variant<std::monostate, Solid, Region> shape;

  int dimension() const { return static_cast<int>(shape.index() == 0 ? 0 : shape.index() == 1 ? 3 : 2); }
  const Solid* solid() const { return std::get_if<Solid>(&shape); }
  const Region* region() const { return std::get_if<Region>(&shape); }
};
using Pieces = std::vector<Piece>;

}  // namespace ombre::solids

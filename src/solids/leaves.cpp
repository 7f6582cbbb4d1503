// The geometry of leaves: primitives, texts and files.
#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "solids/files.h"
#include "solids/kernel.h"
#include "solids/mended_solid.h"
#include "solids/operations.h"
#include "solids/primitives.h"
#include "solids/regions.h"
#include "solids/texts.h"

namespace ombre::solids {
namespace {

Pieces piece_of(TriangleMesh mesh) {
  if (mesh.triangles.empty() || !is_finite(mesh)) return {{}};
  return {{{}, Solid(std::move(mesh))}};
}

Pieces piece_of(Region region) {
  if (region.is_empty()) return {{}};
  return {{{}, std::move(region)}};
}

bool is_finite(const std::vector<Ring>& rings) {
  return std::ranges::all_of(rings, [](const Ring& ring) {
    return std::ranges::all_of(ring, [](const Vec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
  });
}

Pieces piece_of(const std::vector<Ring>& rings) { return is_finite(rings) ? piece_of(region_of(rings)) : Pieces{{}}; }

class Leaf {
 public:
  Leaf(const Tree& tree, const OperationContext& context) : tree_(tree), context_(context) {}

  Pieces operator()(const Cube& cube) const { return piece_of(mesh_of(cube)); }
  Pieces operator()(const Sphere& sphere) const { return piece_of(mesh_of(sphere)); }
  Pieces operator()(const Cylinder& cylinder) const { return piece_of(mesh_of(cylinder)); }
  Pieces operator()(const Polyhedron& polyhedron) const {
    if (is_wrong(polyhedron)) return {{}};
    TriangleMesh mesh = mesh_of(polyhedron, tree_.where, messages());
    if (mesh.triangles.empty() || !is_finite(mesh)) return {{}};
    const auto solid = mended_solid(mesh, "the polyhedron", tree_.where, messages());
    return {{{}, solid ? std::variant<std::monostate, Solid, Region>(*solid) : std::monostate{}}};
  }
  Pieces operator()(const Square& square) const { return piece_of(rings_of(square)); }
  Pieces operator()(const Circle& circle) const { return piece_of(rings_of(circle)); }
  Pieces operator()(const Polygon& polygon) const {
    return is_wrong(polygon) ? Pieces{{}} : piece_of(rings_of(polygon, tree_.where, messages()));
  }
  Pieces operator()(const Text& text) const { return piece_of(region_of_text(text, tree_.where, messages())); }
  Pieces operator()(const Import& import) const {
    Pieces pieces = import_pieces(import, tree_.where, messages());
    if (pieces.empty()) pieces.push_back({});
    return pieces;
  }
  Pieces operator()(const Surface& surface) const { return piece_of(mesh_of(surface, tree_.where, messages())); }
  template <class Operator>
  Pieces operator()(const Operator&) const {
    return {{}};
  }

 private:
  Diagnostics& messages() const { return *context_.messages; }

  template <class Shape>
  bool is_wrong(const Shape& shape) const {
    if (shape.wrong) messages().warning(tree_.where, shape.wrong->message);
    return shape.wrong.has_value();
  }

  const Tree& tree_;
  const OperationContext& context_;
};

}  // namespace

Pieces leaf_pieces(const Tree& tree, const OperationContext& context) {
  try {
    return std::visit(Leaf(tree, context), tree.operation);
  } catch (const Error& error) {
    context.messages->error(tree.where, error.what());
    return {{}};
  }
}

bool is_leaf(const Operation& operation) {
  return std::visit(
      [](const auto& v) {
        using T = std::decay_t<decltype(v)>;
        return std::is_same_v<T, Cube> || std::is_same_v<T, Sphere> || std::is_same_v<T, Cylinder> ||
               std::is_same_v<T, Polyhedron> || std::is_same_v<T, Square> || std::is_same_v<T, Circle> ||
               std::is_same_v<T, Polygon> || std::is_same_v<T, Text> || std::is_same_v<T, Import> ||
               std::is_same_v<T, Surface>;
      },
      operation);
}

}  // namespace ombre::solids

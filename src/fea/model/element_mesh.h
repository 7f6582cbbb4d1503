// Meshes of elements of one kind with nodes anywhere: tetrahedra and hexahedra.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fea/model/bricks.h"

namespace ombre::fea {

// Kinds of elements, named as in Abaqus and CalculiX. Their nodes have the same order there and in VTK.
enum class ElementKind : uint8_t {
  c3d4,   // tetrahedron: three nodes that turn counter-clockwise as seen from the fourth
  c3d10,  // tetrahedron with further nodes in the middle of the edges 12, 23, 31, 14, 24, 34
  c3d8,   // hexahedron, with nodes ordered as in bricks
};

struct ElementShape {
  size_t nodes = 0, corners = 0;
  const char* name = "";
  uint8_t vtk_type = 0;
  // The nodes of each side, corners first, counter-clockwise as seen from outside. The number of a side is one less
  // than in decks' loads on faces.
  std::span<const std::array<uint8_t, 6>> sides;
  size_t side_nodes = 0, side_corners = 0;
};
const ElementShape& shape_of(ElementKind kind);

struct Mesh {
  ElementKind kind = ElementKind::c3d4;
  std::vector<Vec3> points;     // mm
  std::vector<uint32_t> nodes;  // nodes of the first element, of the second, and so on
};

// A view of a mesh for writers, studies and solvers: of bricks or of another mesh, which must outlive it.
class MeshView {
 public:
  MeshView(const Bricks& bricks) : bricks_(&bricks) {}  // NOLINT: a view of what is handed over
  MeshView(const Mesh& mesh) : mesh_(&mesh) {}          // NOLINT

  const Bricks* bricks() const { return bricks_; }  // null for other meshes
  ElementKind kind() const { return bricks_ ? ElementKind::c3d8 : mesh_->kind; }
  const ElementShape& shape() const { return shape_of(kind()); }
  size_t count() const { return bricks_ ? bricks_->count() : mesh_->nodes.size() / shape().nodes; }
  size_t node_count() const { return bricks_ ? bricks_->node_count() : mesh_->points.size(); }
  Vec3 node(size_t n) const { return bricks_ ? bricks_->node(n) : mesh_->points[n]; }
  std::span<const uint32_t> nodes(size_t element) const {
    if (bricks_) return bricks_->nodes[element];
    const size_t each = shape().nodes;
    return {mesh_->nodes.data() + element * each, each};
  }
  Vec3 centroid(size_t element) const;      // mean of the corners; for a brick the centroid of the part inside
  double volume_mm3(size_t element) const;  // negative if the element is inverted
  double total_volume_mm3() const;
  Box bounds() const;
  double typical_size_mm() const;  // typical size of an element

 private:
  const Bricks* bricks_ = nullptr;
  const Mesh* mesh_ = nullptr;
};

// A side of an element that no other element touches.
struct OuterSide {
  uint32_t element = 0;
  uint8_t side = 0;
};
// Returns the sides in the order of elements, then of the sides of an element.
std::vector<OuterSide> outer_sides(const MeshView& mesh);
// Returns the side's nodes, corners first.
std::vector<uint32_t> side_nodes(const MeshView& mesh, const OuterSide& side);
// A node, and its share of a quantity.
struct NodeShare {
  uint32_t node = 0;
  double share = 0;
};
// Distributes a uniform load on a side to nodes: mm2 for each node. At a cut brick the load acts on the surface inside,
// as seen from the side, of this brick or of those behind it.
std::vector<NodeShare> side_shares(const MeshView& mesh, const OuterSide& side);
// Distributes a uniform load on the volume of an element to nodes: mm3 for each node.
std::vector<NodeShare> volume_shares(const MeshView& mesh, size_t element);
// Returns the outward normal of a side, with the length of its whole area in mm2.
Vec3 side_area(const MeshView& mesh, const OuterSide& side);

// Returns the number of the piece of each element, from 0; elements that share a node are in one piece.
std::vector<uint32_t> pieces_of(const MeshView& mesh);

// Returns the tetrahedra with nodes in the middle of their edges. These come after the other nodes, in the order in
// which elements first have them.
Mesh with_middle_nodes(const Mesh& tetrahedra);

struct MeshQuality {
  size_t inverted = 0;                           // number of elements whose volume is not positive
  double least_dihedral = 0, most_dihedral = 0;  // dihedral angles of tetrahedra, degrees; 0 without tetrahedra
  double worst_aspect = 0;  // longest edge over shortest height of tetrahedra, divided by that of a regular one
  double mean_edge_mm = 0;
};
MeshQuality quality_of(const MeshView& mesh);
// Throws Error, which names the first one, if an element is inverted or flat.
void refuse_inverted(const MeshView& mesh);

}  // namespace ombre::fea

// Meshes of elements of one kind with nodes anywhere: tetrahedra and hexahedra.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fea/model/bricks.h"

namespace ombre::fea {

// Kinds have their names in Abaqus and CalculiX; their nodes have the same order there and in VTK.
enum class ElementKind : uint8_t {
  c3d4,   // tetrahedron: three nodes that turn counter-clockwise as seen from the fourth
  c3d10,  // with nodes in the middle of the edges 12, 23, 31, 14, 24, 34
  c3d8,   // hexahedron: as bricks
};

struct ElementShape {
  size_t nodes = 0, corners = 0;
  const char* name = "";
  uint8_t vtk_type = 0;
  // The nodes of each side, corners first, that turn counter-clockwise as seen from outside. Sides have the numbers
  // that loads on faces have in decks, less one.
  std::span<const std::array<uint8_t, 6>> sides;
  size_t side_nodes = 0, side_corners = 0;
};
const ElementShape& shape_of(ElementKind kind);

struct Mesh {
  ElementKind kind = ElementKind::c3d4;
  std::vector<Vec3> points;     // mm
  std::vector<uint32_t> nodes;  // of the first element, of the second, and so on
};

// A mesh as writers, studies and solvers see it: bricks or another one, which must live as long.
class MeshView {
 public:
  MeshView(const Bricks& bricks) : bricks_(&bricks) {}  // NOLINT: a view of what is handed over
  MeshView(const Mesh& mesh) : mesh_(&mesh) {}          // NOLINT

  const Bricks* bricks() const { return bricks_; }  // null where it is not of bricks
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
  Vec3 centroid(size_t element) const;      // the mean of its corners; of a brick that of what is inside
  double volume_mm3(size_t element) const;  // negative where it is inside out
  double total_volume_mm3() const;
  Box bounds() const;
  double typical_size_mm() const;  // of an element

 private:
  const Bricks* bricks_ = nullptr;
  const Mesh* mesh_ = nullptr;
};

// A side of an element that no other element touches.
struct OuterSide {
  uint32_t element = 0;
  uint8_t side = 0;
};
// Sides come in the order of elements, then of an element's sides.
std::vector<OuterSide> outer_sides(const MeshView& mesh);
// The side's nodes, corners first.
std::vector<uint32_t> side_nodes(const MeshView& mesh, const OuterSide& side);
// A node, and how much of something comes to it.
struct NodeShare {
  uint32_t node = 0;
  double share = 0;
};
// What acts evenly on a side: mm2 for each node. Where a brick is cut, it acts on the surface inside, as seen from the
// side, of this brick or of those behind it.
std::vector<NodeShare> side_shares(const MeshView& mesh, const OuterSide& side);
// What acts evenly on the volume of an element: mm3 for each node.
std::vector<NodeShare> volume_shares(const MeshView& mesh, size_t element);
// Outwards, as long as the whole side's area in mm2.
Vec3 side_area(const MeshView& mesh, const OuterSide& side);

// The number of the piece of each element, from 0: elements that share a node belong together.
std::vector<uint32_t> pieces_of(const MeshView& mesh);

// Tetrahedra with nodes in the middle of their edges, behind those that are there, in the order in which elements first
// have them.
Mesh with_middle_nodes(const Mesh& tetrahedra);

struct MeshQuality {
  size_t inverted = 0;                           // elements of no volume or less
  double least_dihedral = 0, most_dihedral = 0;  // degrees, of tetrahedra; 0 without
  double worst_aspect = 0;  // of tetrahedra: the longest edge by the shortest height, in those of a regular one
  double mean_edge_mm = 0;
};
MeshQuality quality_of(const MeshView& mesh);
// Throws Error, which names the first one, when an element is inside out or flat.
void refuse_inverted(const MeshView& mesh);

}  // namespace ombre::fea

// Makes blocks of any elements for tests.
#pragma once

#include <random>

#include "fea/model/model.h"
#include "fea/model/test_models.h"

namespace ombre::fea::test {

// Returns a block with a corner in the origin; inner nodes are moved by up to `shift` of a cell. Tetrahedra come six to
// a cell (Kuhn's), around its diagonal.
inline Mesh block_of(ElementKind kind, Cell count, Vec3 size_mm, double shift = 0) {
  const Bricks bricks = block(count, size_mm);
  std::mt19937 random(5);
  const auto any = [&] { return shift * (static_cast<double>(random() % 2001) / 1000 - 1); };
  Mesh mesh{kind == ElementKind::c3d8 ? kind : ElementKind::c3d4, {}, {}};
  for (size_t n = 0; n < bricks.node_count(); ++n) {
    const Cell& at = bricks.corners[n];
    bool is_inner = true;
    for (size_t axis = 0; axis < 3; ++axis) is_inner = is_inner && at[axis] > 0 && at[axis] < count[axis];
    Vec3 p = bricks.node(n);
    if (is_inner) p = p + Vec3{any() * size_mm.x, any() * size_mm.y, any() * size_mm.z};
    mesh.points.push_back(p);
  }
  constexpr std::array<std::array<size_t, 4>, 6> kuhn{
      {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};
  for (const auto& nodes : bricks.nodes) {
    if (kind == ElementKind::c3d8) mesh.nodes.insert(mesh.nodes.end(), nodes.begin(), nodes.end());
    for (const auto& corners : kuhn)
      for (const size_t c : corners)
        if (kind != ElementKind::c3d8) mesh.nodes.push_back(nodes[c]);
  }
  return kind == ElementKind::c3d10 ? with_middle_nodes(mesh) : mesh;
}

// Returns a model of one material.
inline MeshModel mesh_model_of(Mesh mesh, Elastic elastic) {
  MeshModel model{std::move(mesh), {{"one", elastic}}, {}, {}};
  model.section_of.assign(MeshView(model.mesh).count(), 0);
  return model;
}

}  // namespace ombre::fea::test

// Blocks of bricks for tests.
#pragma once

#include <functional>

#include "fea/model.h"

namespace ombre::fea::test {

inline Bricks block(Cell count, Vec3 size_mm, Vec3 origin = {}) {
  std::vector<Cell> cells;
  for (int32_t k = 0; k < count[2]; ++k)
    for (int32_t j = 0; j < count[1]; ++j)
      for (int32_t i = 0; i < count[0]; ++i) cells.push_back({i, j, k});
  return make_bricks(origin, size_mm, std::move(cells));
}

// A model of one material.
inline Model model_of(Bricks bricks, Elastic elastic) {
  Model model{std::move(bricks), {{"one", elastic}}, {}, {}};
  model.section_of.assign(model.bricks.count(), 0);
  return model;
}

// Displacements by a function of the node's place, where another says so; axes that it leaves are NaN.
inline Conditions held(const MeshView& mesh, const std::function<bool(Vec3)>& where,
                       const std::function<Vec3(Vec3)>& displacement) {
  Conditions conditions;
  for (uint32_t n = 0; n < mesh.node_count(); ++n) {
    const Vec3 p = mesh.node(n);
    if (!where(p)) continue;
    for (uint8_t axis = 0; axis < 3; ++axis)
      if (const double value = displacement(p)[axis]; value == value)
        conditions.displacements.push_back({n, axis, value});
  }
  return conditions;
}

}  // namespace ombre::fea::test

// Makes blocks of bricks for tests.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "fea/model/model.h"

namespace ombre::fea::test {

inline Bricks block(Cell count, Vec3 size_mm, Vec3 origin = {}) {
  std::vector<Cell> cells;
  for (int32_t k = 0; k < count[2]; ++k)
    for (int32_t j = 0; j < count[1]; ++j)
      for (int32_t i = 0; i < count[0]; ++i) cells.push_back({i, j, k});
  return make_bricks(origin, size_mm, std::move(cells));
}

// Returns a block from the origin of any size, as bricks with their fill.
inline Bricks cut_block(Vec3 block_mm, double brick_mm) {
  const auto part_is_inside = [&](const Cell& cell, const std::array<size_t, 3>& part) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<size_t>(axis);
      const double middle = cell[at] + (static_cast<double>(part[at]) + 0.5) / parts_along;
      if (middle * brick_mm > block_mm[axis]) return false;
    }
    return true;
  };
  const auto fill_of = [&](const Cell& cell) {
    Fill fill = 0;
    for (size_t n = 0; n < parts_of_brick; ++n)
      if (part_is_inside(cell, {n % 4, n / 4 % 4, n / 16})) fill |= Fill{1} << n;
    return fill;
  };
  std::vector<Cell> cells;
  std::vector<Fill> fills;
  const auto along = [&](int axis) { return static_cast<int32_t>(std::ceil(block_mm[axis] / brick_mm - 1e-9)); };
  for (int32_t k = 0; k < along(2); ++k)
    for (int32_t j = 0; j < along(1); ++j)
      for (int32_t i = 0; i < along(0); ++i) {
        cells.push_back({i, j, k});
        fills.push_back(fill_of({i, j, k}));
      }
  Bricks bricks = make_bricks({}, {brick_mm, brick_mm, brick_mm}, std::move(cells));
  bricks.fills = std::move(fills);
  return bricks;
}

// Returns a model of one material.
inline Model model_of(Bricks bricks, Elastic elastic) {
  Model model{std::move(bricks), {{"one", elastic}}, {}, {}};
  model.section_of.assign(model.bricks.count(), 0);
  return model;
}

inline constexpr Elastic rigid{2850, 0.39, 0};

// Displacements that are linear in space, and so have the same strains everywhere.
inline Vec3 linear_displacement(Vec3 p) {
  return {1e-3 * p.x + 2e-3 * p.y - 1e-3 * p.z, 5e-4 * p.x - 1e-3 * p.y, 3e-3 * p.z + 1e-3 * p.y};
}
// Expects the stresses that Hooke's law gives for their strains in the rigid material.
inline void expect_linear_stresses(const std::vector<std::array<double, 6>>& stresses_mpa) {
  const double lambda = 2850 * 0.39 / (1.39 * 0.22), mu = 2850 / (2 * 1.39), trace = 3e-3;
  const double wanted[]{lambda * trace + 2 * mu * 1e-3,
                        lambda * trace - 2 * mu * 1e-3,
                        lambda * trace + 2 * mu * 3e-3,
                        mu * 2.5e-3,
                        mu * 1e-3,
                        mu * -1e-3};
  for (const auto& stress : stresses_mpa)
    for (size_t n = 0; n < 6; ++n) EXPECT_NEAR(stress[n], wanted[n], 1e-5);
}

// Prescribes displacements by a function of the node's place, at nodes for which `where` is true; axes with NaN stay
// free.
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

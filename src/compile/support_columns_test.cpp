#include "compile/support_columns.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace ombre::compile {
namespace {

constexpr int cells = 6;

class SupportColumns : public testing::Test {
 protected:
  void SetUp() override {
    lattice_.origin = {-3, 1, 2};
    lattice_.pitch = {Pitch{1, 2}, Pitch{3, 4}, Pitch{1, 1}};
    lattice_.count = {cells, cells, cells};
    box_ = lattice_.box();
    for (uint32_t column = 0; column < cells * cells; ++column)
      for (int32_t k = 0; k < cells; ++k)
        if (number(0, 1) < 0.4) {
          stacks_.push_back({column, k, k + 1});
          filled_.insert({column, k});
        }
    source_ = make_columns(lattice_, box_, stacks_, {});
  }

  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  Vec3 point(double beyond) {
    const Box box = box_.expanded(beyond);
    return {number(box.lo.x, box.hi.x), number(box.lo.y, box.hi.y), number(box.lo.z, box.hi.z)};
  }

  // To the nearest filled cell, or to the nearest that is not, by looking at all; the empty ones go on around.
  double away(Vec3 p, bool filled) const {
    double least = Box::inf;
    for (int i = -1; i <= cells; ++i)
      for (int j = -1; j <= cells; ++j)
        for (int k = -1; k <= cells; ++k) {
          const bool is_there =
              i >= 0 && j >= 0 && i < cells && j < cells && filled_.contains({static_cast<uint32_t>(i + cells * j), k});
          if (is_there != filled) continue;
          const Vec3 size = lattice_.voxel_mm(), lo = lattice_.center(i, j, k) - 0.5 * size, hi = lo + size;
          Vec3 out;
          for (int axis = 0; axis < 3; ++axis) out[axis] = std::max({lo[axis] - p[axis], p[axis] - hi[axis], 0.0});
          least = std::min(least, length(out));
        }
    return least;
  }

  voxel::Lattice lattice_;
  Box box_;
  std::vector<Stack> stacks_;
  std::set<std::pair<uint32_t, int32_t>> filled_;
  program::SourceField source_;
  std::mt19937 random_{1};
};

}  // namespace

TEST_F(SupportColumns, AreTheirCells) {
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k) {
        const bool is_there = filled_.contains({static_cast<uint32_t>(i + cells * j), k});
        EXPECT_EQ(source_->sample(0, lattice_.center(i, j, k)), is_there ? 1 : 0);
      }
}

TEST_F(SupportColumns, DistancesAreExactUpToACell) {
  constexpr double shortest = 0.5;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = point(0);
    const bool is_inside = source_->sample(0, p) == 1;
    const double exact = std::min(away(p, !is_inside), shortest);
    EXPECT_NEAR(source_->sample(1, p), is_inside ? -exact : exact, 1e-12);
  }
}

TEST_F(SupportColumns, DistancesAreBounds) {
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = point(3), q = p + Vec3{number(-1, 1), number(-1, 1), number(-1, 1)};
    const double here = source_->sample(1, p);
    EXPECT_LE(std::abs(here - source_->sample(1, q)), length(p - q) + 1e-12);
    if (here > 0) {
      EXPECT_LE(here, away(p, true) + 1e-12);
    }
    EXPECT_EQ(here <= 0, source_->sample(0, p) == 1);
  }
}

TEST_F(SupportColumns, RangesHoldPoints) {
  for (int n = 0; n < 300; ++n) {
    const Vec3 lo = point(2);
    const Vec3 size{number(0, 2), number(0, 2), number(0, 2)};
    const Box box{lo, lo + size};
    for (const int channel : {0, 1}) {
      const Interval range = source_->range(channel, box);
      for (int i = 0; i < 10; ++i) {
        const Vec3 p = lo + Vec3{number(0, size.x), number(0, size.y), number(0, size.z)};
        EXPECT_TRUE(range.contains(source_->sample(channel, p)));
      }
    }
  }
}

}  // namespace ombre::compile

#include "fea/model/repeat.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fea/model/bricks.h"

namespace ombre::fea {

TEST(Repeat, AFullCellHasOneNodeForEachBrick) {
  std::vector<Cell> cells;
  for (int32_t k = 0; k < 2; ++k)
    for (int32_t j = 0; j < 3; ++j)
      for (int32_t i = 0; i < 4; ++i) cells.push_back({i, j, k});
  const Bricks bricks = make_bricks({-1, 2, 0.3}, {0.7, 1, 1.5}, cells);
  const Vec3 period{4 * 0.7, 3, 3};
  const std::vector<Tie> ties = ties_of(bricks, period);
  EXPECT_EQ(bricks.node_count() - ties.size(), cells.size());
  for (const Tie& tie : ties) {
    const Vec3 away = bricks.node(tie.node) - bricks.node(tie.of);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(away[axis], tie.periods[static_cast<size_t>(axis)] * period[axis], 1e-12);
    EXPECT_EQ(std::ranges::find(ties, tie.of, &Tie::node), ties.end()) << "a copy of a copy";
  }
}

TEST(Repeat, ACopyNeedsNoOriginalInTheCell) {
  // The two bricks touch only the upper end of y, so only their ends along x repeat.
  const Bricks bricks = make_bricks({}, {1, 1, 1}, {{0, 1, 0}, {1, 1, 0}});
  const std::vector<Tie> ties = ties_of(bricks, {2, 4, 4});
  ASSERT_EQ(ties.size(), 4U);
  for (const Tie& tie : ties) EXPECT_EQ(tie.periods, (std::array{1, 0, 0}));
}

TEST(Repeat, ShearsAreTwiceTheTensors) {
  const Repeat repeat{{10, 20, 30}, {}, {0.1, 0.2, 0.3, 0.02, 0.04, 0.06}};
  EXPECT_LT(length(repeat.displacement_mm(0) - Vec3{1, 0.1, 0.3}), 1e-12);
  EXPECT_LT(length(repeat.displacement_mm(1) - Vec3{0.2, 4, 0.4}), 1e-12);
  EXPECT_LT(length(repeat.displacement_mm(2) - Vec3{0.9, 0.6, 9}), 1e-12);
}

// Half of the cell is a layer under stress, so the mean is half of that stress.
TEST(Repeat, MeanStressesAreOfTheWholePeriod) {
  const Bricks bricks = make_bricks({}, {1, 1, 1}, {{0, 0, 0}});
  const std::array<double, 6> stress{8, 6, 4, 2, 1, -2};
  EXPECT_EQ(mean_stress(bricks, {stress}, {1, 1, 2}), (std::array<double, 6>{4, 3, 2, 1, 0.5, -1}));
}

}  // namespace ombre::fea

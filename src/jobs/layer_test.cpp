#include "jobs/slice/layer.h"

#include <gtest/gtest.h>

namespace ombre::compile {
namespace {

// 0.1 mm has no exact double, so at faces such as 0.3 or 0.7 rounding could slip by a voxel.
const voxel::Lattice lattice{{0, -1, -0.5}, {Pitch{1, 10}, Pitch{1, 5}, Pitch{1, 10}}, {10, 10, 10}};

}  // namespace

TEST(Layer, FacesBelongToTheLayerAboveThem) {
  for (int k = 0; k < 10; ++k) {
    const double face = -0.5 + Pitch{1, 10}.times(k);
    EXPECT_EQ(layer_at(lattice, face), k);
    EXPECT_EQ(layer_at(lattice, face + 0.05), k);
    EXPECT_EQ(layer_at(lattice, face + 0.0999), k);
  }
  EXPECT_EQ(layer_at(lattice, 0.5), 9);
  EXPECT_FALSE(layer_at(lattice, 0.51));
  EXPECT_FALSE(layer_at(lattice, -0.51));
  EXPECT_FALSE(layer_at(lattice, std::nan("")));
}

TEST(Layer, WindowsHoldTheVoxelsThatTheyTouch) {
  const auto whole = window_over(lattice, -5, -5, 5, 5);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->lo, (std::array<int64_t, 2>{0, 0}));
  EXPECT_EQ(whole->hi, (std::array<int64_t, 2>{10, 10}));
  // There are faces at 0.3 ... 0.7 along x, and at -0.6 and 0.2 along y.
  const auto exact = window_over(lattice, 0.3, -0.6, 0.7, 0.2);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->lo, (std::array<int64_t, 2>{3, 2}));
  EXPECT_EQ(exact->hi, (std::array<int64_t, 2>{7, 6}));
  const auto touched = window_over(lattice, 0.31, -0.59, 0.71, 0.21);
  ASSERT_TRUE(touched);
  EXPECT_EQ(touched->lo, (std::array<int64_t, 2>{3, 2}));
  EXPECT_EQ(touched->hi, (std::array<int64_t, 2>{8, 7}));
  EXPECT_FALSE(window_over(lattice, 1, 0, 2, 1));
  EXPECT_FALSE(window_over(lattice, 0.5, 0, 0.5, 1));
  EXPECT_FALSE(window_over(lattice, 0.7, 0, 0.3, 1));
}

}  // namespace ombre::compile

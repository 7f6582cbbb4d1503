#include "base/math/box.h"

#include <gtest/gtest.h>

#include <random>

namespace ombre {
namespace {

const Box unit = Box::centered({1, 1, 1});

}  // namespace

TEST(Box, EmptyAndUnbounded) {
  EXPECT_TRUE(Box::empty().is_empty());
  EXPECT_TRUE(Box{}.is_empty());
  EXPECT_FALSE(Box::empty().is_bounded());
  EXPECT_FALSE(Box::everything().is_empty());
  EXPECT_FALSE(Box::everything().is_bounded());
  EXPECT_TRUE((Box{{0, 0, 0}, {0, 0, 0}}.is_bounded()));  // a single point
  EXPECT_TRUE((Box{{0, 0, std::nan("")}, {1, 1, 1}}.is_empty()));
  EXPECT_EQ(Box::empty().size(), Vec3{});
  EXPECT_TRUE(Box::everything().contains({1e300, -1e300, 0}));
  EXPECT_FALSE(Box::empty().contains({}));
}

TEST(Box, ContainsItsFaces) {
  EXPECT_TRUE(unit.contains({1, -1, 1}));
  EXPECT_FALSE(unit.contains({1.0000001, 0, 0}));
  EXPECT_FALSE(unit.contains({0, std::nan(""), 0}));
  EXPECT_EQ(unit.size(), (Vec3{2, 2, 2}));
  EXPECT_EQ((Box{{0, 2, 4}, {2, 4, 8}}.center()), (Vec3{1, 3, 6}));
  EXPECT_EQ((Box{{0, 2, 4}, {2, 4, 8}}.axis(2)), Interval(4, 8));
}

TEST(Box, Expanded) {
  EXPECT_EQ(unit.expanded(0.5), Box::centered({1.5, 1.5, 1.5}));
  EXPECT_TRUE(unit.expanded(-2).is_empty());
  EXPECT_TRUE(Box::empty().expanded(Box::inf).is_empty());
  EXPECT_EQ(Box::everything().expanded(1), Box::everything());
}

TEST(Box, IntersectionAndHull) {
  const Box other{{0, 0, 0}, {3, 3, 3}}, away{{5, 0, 0}, {6, 1, 1}};
  EXPECT_EQ(intersect(unit, other), (Box{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(hull(unit, other), (Box{{-1, -1, -1}, {3, 3, 3}}));
  EXPECT_EQ(intersect(unit, away), Box::empty());
  EXPECT_EQ(intersect(unit, Box::everything()), unit);
  EXPECT_EQ(hull(unit, Box::empty()), unit);
  EXPECT_EQ(hull(Box::empty(), unit), unit);
  EXPECT_EQ(hull(unit, Box::everything()), Box::everything());
  EXPECT_EQ(hull(unit.expanded(-2), other), other);  // a box turned inside out is empty
  EXPECT_EQ(intersect(unit, {{1, -1, -1}, {2, 1, 1}}), (Box{{1, -1, -1}, {1, 1, 1}}));  // a shared face
}

TEST(Box, ImageOfAMap) {
  EXPECT_EQ(image({}, unit), unit);
  EXPECT_EQ(image(Affine::translation({1, 2, 3}), unit), (Box{{0, 1, 2}, {2, 3, 4}}));
  EXPECT_EQ(image(Affine::scaling({-2, 1, 0}), unit), (Box{{-2, -1, 0}, {2, 1, 0}}));
  // A quarter turn about z swaps the sides exactly.
  EXPECT_EQ(image(Affine::rotation({0, 0, 1}, 90), Box{{0, 0, 0}, {1, 2, 3}}), (Box{{-2, 0, 0}, {0, 1, 3}}));
  // A square turned by 45 degrees extends to sqrt(2).
  EXPECT_NEAR(image(Affine::rotation({0, 0, 1}, 45), unit).hi.x, std::sqrt(2), 1e-15);
  EXPECT_TRUE(image(Affine::rotation({1, 1, 0}, 33), Box::empty()).is_empty());
  EXPECT_EQ(image(Affine::rotation({1, 1, 0}, 33), Box::everything()), Box::everything());
  // A slab turned about its normal stays a slab. A tilted slab is unbounded on all axes that mix.
  const Box slab{{-Box::inf, -Box::inf, 0}, {Box::inf, Box::inf, 1}};
  EXPECT_EQ(image(Affine::rotation({0, 0, 1}, 30), slab), slab);
  EXPECT_EQ(image(Affine::rotation({1, 0, 0}, 30), slab).lo.z, -Box::inf);
  // A half-space, mirrored.
  EXPECT_EQ(image(Affine::scaling({-1, 1, 1}), {{0, -Box::inf, -Box::inf}, {Box::inf, Box::inf, Box::inf}}),
            (Box{{-Box::inf, -Box::inf, -Box::inf}, {0, Box::inf, Box::inf}}));
}

TEST(Box, ImageHoldsTheImagesOfPoints) {
  std::mt19937 random(23);
  const auto number = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  for (int i = 0; i < 1000; ++i) {
    const Affine map = Affine::translation({number(-9, 9), number(-9, 9), number(-9, 9)}) *
                       Affine::rotation({number(-1, 1), number(-1, 1), 2}, number(-180, 180)) *
                       Affine::scaling({number(-3, 3), number(-3, 3), number(-3, 3)});
    const Box box{{number(-5, 0), number(-5, 0), number(-5, 0)}, {number(0, 5), number(0, 5), number(0, 5)}};
    const Box mapped = image(map, box).expanded(1e-13);
    Box corners;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p =
          map({corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z});
      EXPECT_TRUE(mapped.contains(p));
      corners = hull(corners, {p, p});
    }
    // The image is no larger than the mapped corners require.
    EXPECT_NEAR(length(corners.size() - mapped.size()), 0, 1e-12);
  }
}

}  // namespace ombre

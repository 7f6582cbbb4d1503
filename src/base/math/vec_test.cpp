// Checks affine maps against linear algebra.
#include "base/math/vec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ombre {
namespace {

const Vec3 ex{1, 0, 0}, ey{0, 1, 0}, ez{0, 0, 1};

class RandomMaps {
 public:
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  Vec3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  Affine turn() { return Affine::rotation(vector(1) + Vec3{2, 0, 0}, number(-360, 360)); }
  Affine any() {
    const Vec3 s{number(0.2, 5), number(0.2, 5), number(-5, -0.2)};
    return Affine::translation(vector(50)) * turn() * Affine::scaling(s) * turn();
  }

 private:
  std::mt19937 random_{17};
};

void expect_near(Vec3 a, Vec3 b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance);
}

}  // namespace

TEST(Vec, Products) {
  EXPECT_EQ(cross(ex, ey), ez);
  EXPECT_EQ(cross(ey, ez), ex);
  EXPECT_EQ(cross(ez, ex), ey);
  EXPECT_EQ(dot({1, 2, 3}, {4, -5, 6}), 12);
  EXPECT_EQ(length({2, 3, 6}), 7);
  EXPECT_FALSE(is_finite({0, std::nan(""), 0}));
  EXPECT_FALSE(is_finite({0, 0, -HUGE_VAL}));
}

TEST(Affine, QuarterTurnsAreExact) {
  struct {
    Vec3 axis, from, to;
  } const cases[] = {{ez, ex, ey}, {ex, ey, ez}, {ey, ez, ex}, {-ez, ey, ex}};
  for (const auto& c : cases) {
    // The length of the axis must not matter, although 1/49 * 49 is not 1 in doubles.
    for (const double size : {1.0, 3.0, 49.0, 0.1, 1e-200, 1e200}) {
      const Vec3 axis = size * c.axis;
      EXPECT_EQ(Affine::rotation(axis, 90)(c.from), c.to) << size;
      EXPECT_EQ(Affine::rotation(axis, -270)(c.from), c.to) << size;
      EXPECT_EQ(Affine::rotation(axis, 90 + 360 * 1000.0)(c.from), c.to) << size;
      EXPECT_EQ(Affine::rotation(axis, -90)(c.to), c.from) << size;
      EXPECT_EQ(Affine::rotation(axis, 180)(c.from), -c.from) << size;
      EXPECT_EQ(Affine::rotation(axis, -180)(c.from), -c.from) << size;
      EXPECT_TRUE(Affine::rotation(axis, 360).is_identity()) << size;
      EXPECT_TRUE(Affine::rotation(axis, 0).is_identity()) << size;
    }
  }
}

TEST(Affine, RotationIsRightHandedAndKeepsLengths) {
  RandomMaps random;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 axis = random.vector(1) + Vec3{0, 0, 2};
    const double degrees = random.number(-720, 720);
    const Affine turn = Affine::rotation(axis, degrees);
    expect_near(turn(axis), axis, 1e-14 * 8);
    EXPECT_NEAR(determinant(turn), 1, 1e-14);
    const Vec3 p = random.vector(10);
    EXPECT_NEAR(length(turn(p)), length(p), 1e-13 * length(p));
    expect_near(Affine::rotation(axis, -degrees)(turn(p)), p, 1e-13);
  }
  // A turn by 120 degrees about the diagonal permutes the axes.
  expect_near(Affine::rotation({1, 1, 1}, 120)(ex), ey, 1e-15);
  // A turn by 30 degrees about z.
  expect_near(Affine::rotation(ez, 30)(ex), {std::sqrt(3) / 2, 0.5, 0}, 1e-15);
}

TEST(Affine, InverseUndoes) {
  RandomMaps random;
  for (int i = 0; i < 1000; ++i) {
    const Affine map = random.any();
    for (const Affine& unit : {inverse(map) * map, map * inverse(map)}) {
      expect_near(unit.rows[0], ex, 1e-13);
      expect_near(unit.rows[1], ey, 1e-13);
      expect_near(unit.rows[2], ez, 1e-13);
      expect_near(unit.offset, {}, 1e-11);
    }
  }
  // Very small and large scales: 1e-110 cubed is below the least double.
  for (const double scale : {1e-110, 1e-60, 1e60, 1e110}) {
    const Affine map = Affine::scaling({scale, scale, scale});
    expect_near((inverse(map) * map)({1, 2, 3}), {1, 2, 3}, 1e-14);
  }
}

TEST(Affine, CompositionAppliesTheRightOneFirst) {
  const Affine both = Affine::translation({1, 0, 0}) * Affine::scaling({2, 3, 4});
  EXPECT_EQ(both({1, 1, 1}), (Vec3{3, 3, 4}));
  EXPECT_EQ(both.linear({1, 1, 1}), (Vec3{2, 3, 4}));
  RandomMaps random;
  for (int i = 0; i < 200; ++i) {
    const Affine a = random.any(), b = random.any();
    const Vec3 p = random.vector(3);
    expect_near((a * b)(p), a(b(p)), 1e-10);
  }
}

TEST(Affine, Determinants) {
  EXPECT_EQ(determinant(Affine{}), 1);
  EXPECT_EQ(determinant(Affine::scaling({2, 3, 4})), 24);
  EXPECT_EQ(determinant(Affine::scaling({-1, 1, 1})), -1);
  EXPECT_EQ(determinant(Affine::scaling({0, 1, 1})), 0);
  RandomMaps random;
  for (int i = 0; i < 200; ++i) {
    const Affine a = random.any(), b = random.any();
    EXPECT_NEAR(determinant(a * b) / (determinant(a) * determinant(b)), 1, 1e-12);
  }
}

TEST(Affine, TurnsMixAxesAndScalesAndMirrorsDoNot) {
  EXPECT_FALSE(mixes_axes({}));
  EXPECT_FALSE(mixes_axes(Affine::translation({1, 2, 3}) * Affine::scaling({2, -3, 0.5})));
  EXPECT_FALSE(mixes_axes(Affine::rotation({0, 0, 1}, 90)));
  EXPECT_TRUE(mixes_axes(Affine::rotation({0, 0, 1}, 30)));
  EXPECT_TRUE(mixes_axes({{Vec3{1, 0.5, 0}, ey, ez}, {}}));
}

TEST(Affine, StretchIsTheSingularValues) {
  RandomMaps random;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 s{random.number(0.01, 0.1), random.number(-1, 1), random.number(-10, -2)};
    const Stretch factors = stretch(random.turn() * Affine::scaling(s) * random.turn());
    // The factors come from squares, so the least factor loses precision beside a great one.
    const double least = std::min(s.x, std::abs(s.y));
    EXPECT_NEAR(factors.least, least, 1e-15 * s.z * s.z / least);
    EXPECT_NEAR(factors.greatest, -s.z, 1e-12);
  }
  // A shear by k has the singular values sqrt(1 + k^2/4) +- k/2.
  const double k = 1.5;
  const Stretch shear = stretch({{Vec3{1, k, 0}, ey, ez}, {}});
  EXPECT_NEAR(shear.greatest, std::sqrt(1 + k * k / 4) + k / 2, 1e-14);
  EXPECT_NEAR(shear.least, std::sqrt(1 + k * k / 4) - k / 2, 1e-14);
  EXPECT_EQ(stretch({}).least, 1);
  EXPECT_EQ(stretch(Affine::scaling({0, 1, 2})).least, 0);
}

}  // namespace ombre

#include "import/cad_source.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"

namespace ombre::importing {
namespace {

class CadSources : public testing::Test {
 protected:
  void SetUp() override {
    try {
      ball_ = cad::read_solids(OMBRE_SOURCE_DIR "/tests/cad/sphere.step");
    } catch (const Error& error) {
      if (std::string(error.what()).find("without Open CASCADE") == std::string::npos) throw;
      GTEST_SKIP() << error.what();
    }
  }

  Vec3 point(double half) { return {1 + number(-half, half), 2 + number(-half, half), 3 + number(-half, half)}; }
  double number(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  // Of the file's ball.
  static double exact(Vec3 p) { return length(p - Vec3{1, 2, 3}) - 4; }

  std::vector<cad::SolidPtr> ball_;
  std::mt19937 random_{1};
};

}  // namespace

TEST_F(CadSources, ExactOnesHaveTheDistanceOfTheSurface) {
  const auto source = make_exact_source("ball", ball_, {}, 0.05);
  const int inside = source->channel("inside"), distance = source->channel("distance");
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = point(6);
    EXPECT_NEAR(source->sample(distance, p), exact(p), 1e-6);
    EXPECT_EQ(source->sample(inside, p), exact(p) <= 0 ? 1 : 0);
  }
}

TEST_F(CadSources, TrianglesAreAsNearAsTheirDeflection) {
  for (const double deflection : {0.1, 0.01}) {
    const auto source = make_triangle_source("ball", ball_, {}, deflection);
    double farthest = 0;
    for (int n = 0; n < 500; ++n) {
      const Vec3 p = point(6);
      farthest = std::max(farthest, std::abs(source->sample(source->channel("distance"), p) - exact(p)));
    }
    EXPECT_LE(farthest, 1.5 * deflection);
    EXPECT_GT(farthest, 0.1 * deflection);
  }
}

TEST_F(CadSources, RangesHoldPoints) {
  const auto source = make_exact_source("ball", ball_, {}, 0.05);
  for (int n = 0; n < 40; ++n) {
    const Vec3 lo = point(6);
    const double side = number(0, 3);
    const Box box{lo, lo + Vec3{side, side, side}};
    for (const int channel : {0, 1}) {
      const Interval range = source->range(channel, box);
      for (int i = 0; i < 10; ++i) {
        const Vec3 p = lo + Vec3{number(0, side), number(0, side), number(0, side)};
        EXPECT_TRUE(range.contains(source->sample(channel, p)));
      }
    }
  }
}

}  // namespace ombre::importing

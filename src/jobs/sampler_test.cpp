// Tests designs at many points at once, against mathematics.
#include "questions/sampler.h"

#include <random>

#include "jobs/test_designs.h"

namespace ombre::compile {
namespace {

double between(std::mt19937& random, double lo, double hi) {
  return lo + (hi - lo) * static_cast<double>(random()) / 4294967295.0;
}

}  // namespace

// There are so many parts that they are a table, of which blocks of points ask a few rows.
TEST(Sampler, FindsPointsInVeryManyBalls) {
  constexpr double radius = 0.5;
  std::mt19937 random(3);
  const auto place = [&] { return Vec3{between(random, 0, 20), between(random, 0, 20), between(random, 0, 20)}; };
  std::string text = "union() {";
  std::vector<Vec3> centres(2000), points(3000);
  for (Vec3& centre : centres) {
    centre = place();
    text += "translate(" + std::to_string(centre.x) + ", " + std::to_string(centre.y) + ", " +
            std::to_string(centre.z) + ") sphere(0.5);\n";
  }
  for (Vec3& point : points) point = place();
  // Many points lie at one place, one is far away, and one is not a number.
  for (size_t n = 0; n < 600; ++n) points[n] = centres[0] + Vec3{0, 0, n % 2 == 0 ? 0.25 : 100};
  points[700] = {1e5, 0, 0};
  points[701] = {std::nan(""), 0, 0};

  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text + "}", diagnostics);
  ASSERT_TRUE(loaded) << to_text(diagnostics);
  const auto sampler = Sampler::build(loaded->design, {true, false, false, false, {}}, diagnostics);
  ASSERT_TRUE(sampler);
  std::vector<double> inside(points.size(), -1);
  sampler->sample(points, std::array{inside.data()});
  for (size_t n = 0; n < points.size(); ++n) {
    double nearest = 1e9;
    for (const Vec3& centre : centres) nearest = std::min(nearest, length(points[n] - centre));
    constexpr double of_six_decimals = 2e-6;
    if (std::abs(nearest - radius) <= of_six_decimals) continue;
    EXPECT_EQ(inside[n], nearest <= radius) << n;
  }
}

}  // namespace ombre::compile

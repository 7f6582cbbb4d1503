#include "render/ray_steps.h"

#include <gtest/gtest.h>

namespace ombre::render {

TEST(Film, IsSymmetricAroundItsMiddle) {
  for (const int64_t width : {1, 4, 7}) {
    const Film film{width, width + 1, 0.5};
    for (int64_t n = 0; n < width; ++n) {
      EXPECT_EQ(film.right_of(n), -film.right_of(width - 1 - n));
      EXPECT_EQ(film.right_of(n + 1) - film.right_of(n), 0.5);
      EXPECT_EQ(film.down_of(n), -film.down_of(width - n));
    }
  }
}

TEST(RaySteps, ReachFromNearToFarInQuartersOfAPixel) {
  Scene scene;
  scene.near_mm = -3;
  for (const double far : {-2.9, 0.0, 4.0, 123.4}) {
    scene.far_mm = far;
    const RaySteps steps(scene, {10, 10, 0.2, 2});
    EXPECT_NEAR(steps.fine_mm * fine_per_step, 0.1, 1e-15);
    EXPECT_EQ(steps.steps % steps_together, 0);
    EXPECT_LE(steps.depth(0), scene.near_mm + 0.1);
    EXPECT_GE(steps.depth(RaySteps::fine_of(steps.steps - 1)), far);
    EXPECT_NEAR(steps.depth(512) - steps.depth(0), 0.1, 1e-12);
  }
}

// A material of opacity 3/4 passes a quarter of the light along four steps, and so half along two.
TEST(Clarity, LightFadesByEqualSharesAlongEqualWays) {
  const Clarity clarity(0.25);
  EXPECT_NEAR(clarity.through(0.75F, 4), 0.25, 1e-6);
  EXPECT_NEAR(clarity.through(0.75F, 2), 0.5, 1e-6);
  EXPECT_NEAR(clarity.through(0.75F, 1), std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(clarity.through(0.75F, murky_steps), 0.0625, 1e-6);
  EXPECT_NEAR(clarity.through(0.75F, 3 * murky_steps), std::pow(0.0625, 3), 1e-7);
}

TEST(Clarity, NothingFadesInClearMaterialAndAllInOpaque) {
  const Clarity clarity(0.1);
  for (const int64_t steps : {int64_t{1}, int64_t{5}, murky_steps}) {
    EXPECT_EQ(clarity.through(0, steps), 1);
    EXPECT_EQ(clarity.through(-2, steps), 1);
    EXPECT_EQ(clarity.through(1, steps), 0);
    EXPECT_EQ(clarity.through(7, steps), 0);
  }
}

}  // namespace ombre::render

#include "render/end_colours.h"

#include <gtest/gtest.h>

#include "program/field.h"

namespace ombre::render {
namespace {

using program::Builder;
using program::Field;

constexpr int64_t side = 90;  // of the film, in rays
const Film film{side, side, 1};

// Returns opaque material between two depths, whose red grows with the depth, and its green to the right.
Scene slab(double front, double back) {
  Builder builder;
  const Field depth = builder.input(0);
  const Field is_inside = logical_and(less_equal(builder.constant(front), depth), depth < back);
  Scene scene;
  scene.program = builder.finish({{"inside", is_inside},
                                  {"opaque", is_inside},
                                  {"red", depth * 0.05},
                                  {"green", builder.input(1) * 0.01 + 0.5},
                                  {"blue", sqrt(builder.input(2))},
                                  {"opacity", builder.constant(1)}});
  scene.far_mm = 20;
  return scene;
}

class Ends : public testing::Test {
 protected:
  void SetUp() override {
    if (eval::kernel_sets().empty()) GTEST_SKIP() << "this processor has no batches";
    for (int64_t row = 0; row < side; ++row)
      for (int64_t column = 0; column < side; ++column) hits.at(column, row) = RayHit::nothing();
  }

  const std::vector<std::unique_ptr<program::RowSampler>> no_samplers = {};
  const voxel::StripSources no_sources{no_samplers, {}};
  RayBand hits{0, side, side};
};

constexpr auto never = [] { return false; };

}  // namespace

// A step is a quarter of a pixel; colours are those half a step behind the surface.
TEST_F(Ends, HaveTheColourRightBehindTheSurface) {
  const Scene scene = slab(1, 10);
  const RaySteps steps(scene, film);
  EndColours ends(scene.program, steps, hits);
  const std::vector<Ray> rays{{3, 5, 2048}, {88, 80, 2048}, {60, 2, 9000}, {0, 89, 4000}};
  for (const Ray& ray : rays) ends.note(ray);
  ends.take(no_sources, never);
  for (const Ray& ray : rays) {
    const Colour& colour = hits.at(ray.column, ray.row).at_end;
    EXPECT_NEAR(colour.red, 0.05 * (steps.depth(ray.first) + 0.125), 1e-6);
    EXPECT_NEAR(colour.green, 0.5 + 0.01 * film.right_of(ray.column), 1e-6);
    // Roots of negative numbers count as 0.
    EXPECT_NEAR(colour.blue, std::sqrt(std::max(0.0, film.down_of(ray.row))), 1e-5);
  }
  EXPECT_EQ(hits.at(4, 5).at_end.red, 0) << "a ray without an end";
}

TEST_F(Ends, OfThinMaterialHaveTheColourOfTheSurface) {
  const Scene scene = slab(1, 1.1);
  const RaySteps steps(scene, film);
  EndColours ends(scene.program, steps, hits);
  ends.note({3, 5, 2048});
  ends.take(no_sources, never);
  EXPECT_NEAR(hits.at(3, 5).at_end.red, 0.05 * steps.depth(2048), 1e-6);
}

TEST_F(Ends, AreTakenOnce) {
  const Scene scene = slab(1, 10);
  const RaySteps steps(scene, film);
  EndColours ends(scene.program, steps, hits);
  ends.take(no_sources, never);
  ends.note({3, 5, 2048});
  ends.take(no_sources, never);
  hits.at(3, 5) = RayHit::nothing();
  ends.note({4, 5, 2048});
  ends.take(no_sources, never);
  EXPECT_EQ(hits.at(3, 5).at_end.red, 0);
  EXPECT_GT(hits.at(4, 5).at_end.red, 0.04F);
}

TEST_F(Ends, StayUnsetOnceWorkIsStopped) {
  const Scene scene = slab(1, 10);
  const RaySteps steps(scene, film);
  EndColours ends(scene.program, steps, hits);
  ends.note({3, 5, 2048});
  ends.take(no_sources, [] { return true; });
  EXPECT_EQ(hits.at(3, 5).at_end.red, 0);
}

}  // namespace ombre::render

#include "render/section.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "program/field.h"

namespace ombre::render {
namespace {

constexpr int64_t width = 61, height = 47;
constexpr double square_radius = 190.3;  // of a disc around the middle of the film, in pixels; no point lies on its rim

program::Program disc() {
  program::Builder builder;
  const program::Field x = builder.input(0) - 0.5 * width, y = builder.input(1) - 0.5 * height;
  return builder.finish({{"inside", square(x) + square(y) < square_radius},
                         {"red", builder.constant(0.25)},
                         {"green", builder.input(0) / 64},
                         {"blue", builder.input(1) / 64}});
}

bool is_in_disc(int64_t column, int64_t row) {
  const double x = static_cast<double>(column) + 0.5 - 0.5 * width, y = static_cast<double>(row) + 0.5 - 0.5 * height;
  return x * x + y * y < square_radius;
}

}  // namespace

TEST(Section, RaysEndWhereTheirPointIsInside) {
  const StopFlag stop;
  for (const int threads : {1, 3}) {
    const RayBand band = Section(disc(), {width, height, 0.1}).cast(0, height, threads, stop);
    for (int64_t row = 0; row < height; ++row)
      for (int64_t column = 0; column < width; ++column) {
        const RayHit& ray = band.at(column, row);
        ASSERT_EQ(ray.surface, is_in_disc(column, row) ? 0 : RayHit::none) << column << " " << row;
        ASSERT_EQ(ray.end, ray.surface);
        if (!is_in_disc(column, row)) continue;
        ASSERT_EQ(ray.at_end.red, 0.25F);
        ASSERT_EQ(ray.at_end.green, (static_cast<float>(column) + 0.5F) / 64);
        ASSERT_EQ(ray.at_end.blue, (static_cast<float>(row) + 0.5F) / 64);
      }
  }
}

TEST(Section, PartsAreThoseOfTheWhole) {
  const StopFlag stop;
  const Section section(disc(), {width, height, 0.1});
  for (int64_t begin = 0; begin < height; begin += 5) {
    const int64_t end = std::min(begin + 5, height);
    const RayBand band = section.cast(begin, end, 1, stop);
    for (int64_t row = begin; row < end; ++row)
      for (int64_t column = 0; column < width; ++column)
        ASSERT_EQ(band.at(column, row).surface, is_in_disc(column, row) ? 0 : RayHit::none);
  }
}

TEST(Section, StopsOnRequest) {
  StopFlag stop;
  stop.request();
  EXPECT_THROW(Section(disc(), {width, height, 0.1}).cast(0, height, 1, stop), Cancelled);
}

// The plane passes through the target; columns go to the right, rows down, and the third coordinate away from the eye.
TEST(Section, LiesInThePlaneThroughTheTarget) {
  const Box box{{1, 2, 3}, {5, 8, 7}};
  const Film film{40, 30, 0.5};
  for (const std::string& name : view_names()) {
    const Camera camera = camera_around(box, *named_view(name), 1);
    const Affine map = Section::design_from_film(camera, film);
    EXPECT_LT(length(map({20, 15, 0.5}) - box.center()), 1e-12);
    EXPECT_LT(length(map({0, 0, 0.5}) - (box.center() - 10 * camera.right - 7.5 * camera.down)), 1e-12);
    EXPECT_LT(length(map({20, 15, 1.5}) - (box.center() + 0.5 * camera.forward)), 1e-12);
    const Vec3 beside = box.center() + film.right_of(7) * camera.right + film.down_of(3) * camera.down;
    EXPECT_LT(length(map({7.5, 3.5, 0.5}) - beside), 1e-12);
  }
}

}  // namespace ombre::render

// Compares places on surfaces with the geometry of planes, cylinders and spheres.
#include "import/charts/place_source.h"

#include <gtest/gtest.h>

#include <random>

#include "import/charts/test_patches.h"

namespace ombre::importing {
namespace {

class PlaceSourceTest : public testing::Test {
 protected:
  static double at(const program::SourceField& source, const char* channel, Vec3 p) {
    return source->sample(source->channel(channel), p);
  }
  static Vec3 vector_at(const program::SourceField& source, std::array<const char*, 3> channels, Vec3 p) {
    return {at(source, channels[0], p), at(source, channels[1], p), at(source, channels[2], p)};
  }
  Vec3 random_point(Vec3 low, Vec3 high) {
    const auto number = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); };
    return {number(low.x, high.x), number(low.y, high.y), number(low.z, high.z)};
  }

  std::mt19937 random_{11};
};

constexpr std::array point{"x", "y", "z"}, normal{"normal_x", "normal_y", "normal_z"};

program::SourceField plane() {
  return make_place_source("plane",
                           grid_patch(
                               7, 5,
                               [](double a, double b) {
                                 return Vec3{20 * a, 10 * b, 3};
                               },
                               [](double a, double b) {
                                 return Vec2{20 * a, 10 * b};
                               }),
                           {});
}

// A tent of two squares of 10 mm that meet at a right angle above x = 0, with its unrolled lengths as places.
SurfacePatch tent() {
  const double down = 10 / std::sqrt(2.0);
  SurfacePatch patch = grid_patch(
      2, 1,
      [=](double a, double b) {
        return Vec3{down * (2 * a - 1), 10 * b, down * (1 - std::abs(2 * a - 1))};
      },
      [](double a, double b) {
        return Vec2{20 * a, 10 * b};
      });
  return patch;
}

// A pyramid without its base, whose tip is at (0, 0, 5).
SurfacePatch pyramid() {
  SurfacePatch patch;
  patch.points = {{4, 4, 0}, {-4, 4, 0}, {-4, -4, 0}, {4, -4, 0}, {0, 0, 5}};
  patch.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  patch.places = {{4, 4}, {-4, 4}, {-4, -4}, {4, -4}, {0, 0}};
  make_normals(patch);
  return patch;
}

}  // namespace

// Above a plane the place is the point; beside it, that of the nearest point of its border.
TEST_F(PlaceSourceTest, OfAPlane) {
  const auto source = plane();
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = random_point({-5, -5, -4}, {25, 15, 10});
    const Vec3 q{std::clamp(p.x, 0.0, 20.0), std::clamp(p.y, 0.0, 10.0), 3};
    EXPECT_NEAR(at(source, "u", p), q.x, 1e-12);
    EXPECT_NEAR(at(source, "v", p), q.y, 1e-12);
    EXPECT_NEAR(at(source, "distance", p), std::copysign(length(p - q), p.z - 3), 1e-12);
    EXPECT_LE(length(vector_at(source, point, p) - q), 1e-12);
    EXPECT_LE(length(vector_at(source, normal, p) - Vec3{0, 0, 1}), 1e-12);
    EXPECT_NEAR(at(source, "border", p), std::min({q.x, 20 - q.x, q.y, 10 - q.y}), 1e-12);
  }
}

// u is the radius times the angle. Chords between points of the cylinder lie below it by the sagitta at most, and
// lengths on a chord, stretched evenly, differ from those on the arc by less than the sagitta times the angle of a
// chord.
TEST_F(PlaceSourceTest, OfACylinderIsUnrolled) {
  constexpr uint32_t columns = 64;
  constexpr double radius = 10, angle = 2, part = angle / columns;
  const auto source = make_place_source("cylinder", cylinder_patch(radius, angle, 12, columns, 6), {});
  const double sagitta = radius * (1 - std::cos(part / 2));
  for (int n = 0; n < 1000; ++n) {
    const Vec3 place = random_point({0.001, 0.001, -6}, {angle - 0.001, 11.999, 6});
    const double r = radius + place.z;
    const Vec3 p{r * std::cos(place.x), r * std::sin(place.x), place.y};
    // From a point at another radius, the chord is seen as turned by at most half the angle of a chord.
    EXPECT_NEAR(at(source, "u", p), radius * place.x, sagitta + std::abs(place.z) * part / 2);
    EXPECT_NEAR(at(source, "v", p), place.y, 1e-9);
    EXPECT_NEAR(at(source, "distance", p), place.z, sagitta * 1.01);
    EXPECT_LE(length(vector_at(source, normal, p) - Vec3{std::cos(place.x), std::sin(place.x), 0}), part);
  }
  for (double u = 1; u < 19; ++u) {
    const Vec3 p{radius * std::cos(u / radius), radius * std::sin(u / radius), 5};
    EXPECT_NEAR(at(source, "u", p), u, sagitta * part);
  }
}

// Above the ridge the nearest point is the ridge itself, from which both sides fall away.
TEST_F(PlaceSourceTest, EdgesHaveTheSideOfBothFaces) {
  const auto source = make_place_source("tent", tent(), {});
  const double ridge = 10 / std::sqrt(2.0);
  EXPECT_NEAR(at(source, "distance", {0.3, 4, ridge + 2}), std::hypot(0.3, 2), 1e-12);
  EXPECT_NEAR(at(source, "u", {0.3, 4, ridge + 2}), 10, 1e-12);
  EXPECT_NEAR(at(source, "v", {0.3, 4, ridge + 2}), 4, 1e-12);
  EXPECT_NEAR(at(source, "distance", {0, 4, ridge - 2}), -std::sqrt(2.0), 1e-12);
  // A steep way from the ridge, seen from below one of the faces' planes, is still outside.
  EXPECT_NEAR(at(source, "distance", {-1, 4, ridge + 1.1}), std::hypot(1, 1.1), 1e-12);
}

TEST_F(PlaceSourceTest, CornersHaveTheSideOfAllFaces) {
  const auto source = make_place_source("pyramid", pyramid(), {});
  for (int n = 0; n < 200; ++n) {
    const Vec3 up = random_point({-0.3, -0.3, 0.5}, {0.3, 0.3, 2});
    EXPECT_NEAR(at(source, "distance", Vec3{0, 0, 5} + up), length(up), 1e-12);
  }
  EXPECT_LT(at(source, "distance", {0, 0, 1}), 0);
}

TEST_F(PlaceSourceTest, RangesEncloseValues) {
  SurfacePatch patch = sphere_patch(10, -0.5, 0.7, 12, 12);
  for (const Vec3& p : patch.points) patch.places.push_back({10 * std::atan2(p.y, p.x), p.z});
  for (const auto& source : {make_place_source("sphere", patch, {}), make_place_source("tent", tent(), {}),
                             make_place_source("pyramid", pyramid(), {}), plane()})
    for (int n = 0; n < 300; ++n) {
      const Vec3 low = random_point({-12, -12, -12}, {14, 14, 12});
      const double size = std::exp(random_point({-4, 0, 0}, {2, 1, 1}).x);
      const Box box{low, low + Vec3{size, size, size}};
      for (int channel = 0; channel < 10; ++channel) {
        const Interval range = source->range(channel, box);
        for (int k = 0; k < 10; ++k) {
          const double value = source->sample(channel, random_point(box.lo, box.hi));
          EXPECT_GE(value, range.lo) << channel;
          EXPECT_LE(value, range.hi) << channel;
        }
      }
    }
}

// The border of the plane z = 3 lies at x = 20: boxes of 1 mm beside it are 1 mm above or below the plane, or around
// it.
TEST_F(PlaceSourceTest, RangesOfDistancesHaveOneSideAlsoBeyondTheBorder) {
  const auto source = plane();
  const auto range = [&](Vec3 low) { return source->range(source->channel("distance"), {low, low + Vec3{1, 1, 1}}); };
  EXPECT_GT(range({19.5, 4, 4}).lo, 0);
  EXPECT_GT(range({21, 4, 4}).lo, 0);
  EXPECT_LT(range({21, 4, 1}).hi, 0);
  EXPECT_LT(range({21, 4, 2.5}).lo, 0);
  EXPECT_GT(range({21, 4, 2.5}).hi, 0);
}

TEST_F(PlaceSourceTest, ChannelsAtOnceAreThoseOneByOne) {
  const auto source = make_place_source("cylinder", cylinder_patch(10, 2, 12, 16, 6), {});
  std::vector<Vec3> points{{Box::inf, 0, 0}};
  while (points.size() < 40) points.push_back(random_point({-12, -12, -2}, {12, 12, 14}));
  const std::vector<int> channels{9, 2, 0, 7};
  std::vector<std::vector<double>> found(channels.size(), std::vector<double>(points.size()));
  std::vector<double*> where;
  for (auto& values : found) where.push_back(values.data());
  source->sample_channels(channels, points, where);
  for (size_t c = 0; c < channels.size(); ++c)
    for (size_t n = 0; n < points.size(); ++n) EXPECT_EQ(found[c][n], source->sample(channels[c], points[n]));
  EXPECT_EQ(source->channel("w"), -1);
}

}  // namespace ombre::importing

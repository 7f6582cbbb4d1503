#include "surface/mesh/facet_distance.h"

#include <gtest/gtest.h>

#include <random>

#include "surface/mesh/surface_distance.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

constexpr Vec3 middle_of_surface{5.1, 4.8, 5.3};

// The surface of a ball of 3 mm in cells of 1 mm.
const PlainSurface& surface_of_ball() {
  static const PlainSurface plain(ball_of(middle_of_surface, 3), corners_from_origin({11, 11, 11}), 0);
  return plain;
}

std::vector<Vec3> places_around(size_t count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 10);
  std::vector<Vec3> points;
  for (size_t n = 0; n < count; ++n) points.push_back({any(random), any(random), any(random)});
  return points;
}

double distance_by_all(Vec3 p, const RegionSurface& built) {
  double nearest = HUGE_VAL;
  for (const Facet& facet : built.facets)
    nearest =
        std::min(nearest, distance_to_triangle(p, {built.vertices[facet.corners[0]], built.vertices[facet.corners[1]],
                                                   built.vertices[facet.corners[2]]}));
  return nearest;
}

}  // namespace

TEST(FacetDistance, IsThatOfTheNearestOfAllFacets) {
  const RegionSurface built = surface_of_ball().surface.build();
  const std::vector<Vec3> points = places_around(300);
  constexpr double reach = 1.5;
  size_t near = 0;
  for (const int threads : {1, 2}) {
    const std::vector<double> found = distances_to_facets(points, surface_of_ball().surface, reach, {threads});
    ASSERT_EQ(found.size(), points.size());
    for (size_t n = 0; n < points.size(); ++n) {
      const double wanted = distance_by_all(points[n], built);
      EXPECT_EQ(found[n], wanted <= reach ? wanted : HUGE_VAL) << n;
      near += wanted <= reach ? 1 : 0;
      // Facets of a ball in cells of a third of its radius lie within about a tenth of a mm.
      EXPECT_NEAR(wanted, std::abs(length(points[n] - middle_of_surface) - 3), 0.15) << n;
    }
  }
  EXPECT_GT(near, 50U);
  EXPECT_TRUE(distances_to_facets({}, surface_of_ball().surface, reach, {1}).empty());
}

TEST(FacetDistance, BallsMeetFacetsAsFarAsTheirRadius) {
  const RegionSurface built = surface_of_ball().surface.build();
  std::vector<Ball> balls;
  for (const Vec3 point : places_around(100)) {
    const double distance = distance_by_all(point, built);
    balls.push_back({point, 1.001 * distance});
    balls.push_back({point, 0.999 * distance});
  }
  const std::vector<bool> meet = meet_facets(balls, surface_of_ball().surface, {1});
  for (size_t n = 0; n < balls.size(); ++n) EXPECT_EQ(meet[n], n % 2 == 0) << n;
}

TEST(FacetDistance, OfSomeQuadsIgnoresTheOthers) {
  const QuadSurface& surface = surface_of_ball().surface;
  const Vec3 on_first = surface.corners(surface.triangles(0)[0])[0];
  const std::vector<Ball> balls{{on_first, 0.01}};
  std::vector<uint32_t> elsewhere;
  for (uint32_t quad = 0; quad < surface.quads(); ++quad)
    if (std::ranges::none_of(surface.triangles(quad), [&](const Triangle& triangle) {
          return distance_to_triangle(on_first, surface.corners(triangle)) < 0.02;
        }))
      elsewhere.push_back(quad);
  EXPECT_TRUE(meet_facets(balls, surface, {0}, {1})[0]);
  EXPECT_FALSE(meet_facets(balls, surface, elsewhere, {1})[0]);
  EXPECT_FALSE(meet_facets(balls, surface, {}, {1})[0]);
}

}  // namespace ombre::surface

// Tests of whole surfaces. Euler: a closed surface of genus g has V - E + F = 2 - 2 g, and E = 3 F / 2.
#include "surface/mesh/contour.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/text/error.h"
#include "surface/mesh/bodies.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

using program::Builder;
using program::Field;

RegionSurface contoured(const Partition& partition, double tolerance_mm, int threads = 1) {
  return contour(partition, {corners_from_origin({23, 23, 23}), tolerance_mm, true, {threads}, 0});
}

int64_t euler_number_of(const Body& body) {
  return static_cast<int64_t>(body.vertices.size()) - static_cast<int64_t>(body.triangles.size() / 2);
}

constexpr double ring = 6.5, tube = 2.6;

Partition torus() {
  return solid_where_negative([](Builder& b) {
    const Field outwards = length(b.input(0) - 11.2, b.input(1) - 10.9) - ring;
    return length(outwards, b.input(2) - 11.1) - tube;
  });
}

}  // namespace

TEST(Contour, SurfacesHaveTheHandlesOfTheirSolids) {
  const Partition two_balls = solid_where_negative([](Builder& b) {
    const auto far = [&](double x) { return length(b.input(0) - x, b.input(1) - 11.3, b.input(2) - 10.8); };
    return min(far(5.6), far(16.4)) - 4.5;
  });
  const Partition shell = solid_where_negative(
      [](Builder& b) { return abs(length(b.input(0) - 11.2, b.input(1) - 10.9, b.input(2) - 11.1) - 6) - 1.5; });
  struct Case {
    const char* name;
    const Partition* partition;
    int64_t euler;
  };
  const Partition ball = ball_of({11.2, 10.9, 11.1}, 8), ring_of_tube = torus();
  for (const Case& one :
       {Case{"ball", &ball, 2}, {"torus", &ring_of_tube, 0}, {"two balls", &two_balls, 4}, {"shell", &shell, 4}})
    for (const double tolerance : {0.2, 0.05}) {
      const RegionSurface surface = contoured(*one.partition, tolerance);
      EXPECT_EQ(euler_number_of(body_of(surface, 1)), one.euler) << one.name << " " << tolerance;
      EXPECT_EQ(surface.report.folded, 0U) << one.name;
      EXPECT_EQ(surface.report.intersections, 0U) << one.name;
      EXPECT_EQ(surface.report.lost.places, 0U) << one.name;
    }
}

// Pappus: a torus has the volume 2 pi^2 R r^2 and the area 4 pi^2 R r.
TEST(Contour, ATorusHasItsVolumeAndArea) {
  const Body body = body_of(contoured(torus(), 0.02), 1);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(volume_mm3(body) / (2 * pi * pi * ring * tube * tube), 1, 0.003);
  EXPECT_NEAR(area_mm2(body) / (4 * pi * pi * ring * tube), 1, 0.01);
  for (const Vec3& v : body.vertices) {
    const double outwards = std::hypot(v.x - 11.2, v.y - 10.9) - ring;
    EXPECT_NEAR(std::hypot(outwards, v.z - 11.1), tube, 0.02);
  }
}

TEST(Contour, IsTheSameForAnyNumberOfThreads) {
  const RegionSurface one = contoured(torus(), 0.05), three = contoured(torus(), 0.05, 3);
  EXPECT_EQ(one.vertices, three.vertices);
  ASSERT_EQ(one.facets.size(), three.facets.size());
  for (size_t n = 0; n < one.facets.size(); ++n) EXPECT_EQ(one.facets[n].corners, three.facets[n].corners);
}

// The pocket of 0.3 mm lies between the corners, in the third of six slabs.
TEST(Contour, IsTheSameWhenBordersAreFoundInSlabs) {
  const Partition partition = solid_where_negative([](Builder& b) {
    const Field outwards = length(b.input(0) - 11.2, b.input(1) - 10.9) - ring;
    const Field pocket = length(b.input(0) - 17.5, b.input(1) - 10.5, b.input(2) - 11.5) - 0.3;
    return max(length(outwards, b.input(2) - 11.1) - tube, -pocket);
  });
  const ContourOptions options{corners_from_origin({23, 23, 23}), 0.05, true, {1}, 0};
  GridBorders known;
  size_t hidden = 0;
  for (int64_t begin = 0; begin < 22; begin += strip_layers)
    known.append(
        find_grid_borders({begin, std::min<int64_t>(begin + strip_layers, 22)}, partition, options.corners, true, {1}));
  for (const auto& strip : known.hidden) hidden += strip.size();
  EXPECT_GT(hidden, 0U);
  const RegionSurface alone = contour(partition, options), joined = contour(partition, options, nullptr, &known);
  EXPECT_EQ(alone.vertices, joined.vertices);
  ASSERT_EQ(alone.facets.size(), joined.facets.size());
  for (size_t n = 0; n < alone.facets.size(); ++n) EXPECT_EQ(alone.facets[n].corners, joined.facets[n].corners);
  known.crossings.pop_back();
  EXPECT_THROW(contour(partition, options, nullptr, &known), Error);
}

TEST(Contour, NeedsMemoryForItsCells) {
  const ContourOptions options{corners_from_origin({23, 23, 23}), 0.05, true, {1}, 10'000};
  try {
    contour(torus(), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::memory);
    EXPECT_NE(std::string(error.what()).find("choose a larger --cell"), std::string::npos);
  }
}

TEST(Contour, StopsOnRequest) {
  StopFlag stop;
  stop.request();
  const ContourOptions options{corners_from_origin({23, 23, 23}), 0.05, true, {1, &stop}, 0};
  EXPECT_THROW(contour(torus(), options), Cancelled);
}

}  // namespace ombre::surface

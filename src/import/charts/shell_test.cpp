// Compares maps of the space above surfaces with the geometry of planes, cylinders and spheres.
#include <gtest/gtest.h>

#include <random>

#include "import/charts/prism_rows.h"
#include "import/charts/surface_rays.h"
#include "import/charts/test_patches.h"

namespace ombre::importing {
namespace {

class ShellTest : public testing::Test {
 protected:
  static double at(const program::SourceField& source, const char* channel, Vec3 p) {
    return source->sample(source->channel(channel), p);
  }
  static Vec3 slope(const program::SourceField& source, const std::string& of, Vec3 p) {
    return {at(source, (of + "_x").c_str(), p), at(source, (of + "_y").c_str(), p), at(source, (of + "_z").c_str(), p)};
  }
  static void expect_near(Vec3 found, Vec3 expected, double room) {
    EXPECT_LE(length(found - expected), room) << found.x << ' ' << found.y << ' ' << found.z;
  }
  Vec3 random_point(Vec3 low, Vec3 high) {
    const auto number = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); };
    return {number(low.x, high.x), number(low.y, high.y), number(low.z, high.z)};
  }

  std::mt19937 random_{3};
};

SurfacePatch plane_patch(uint32_t columns = 7, uint32_t rows = 5) {
  return grid_patch(
      columns, rows,
      [](double a, double b) {
        return Vec3{20 * a, 10 * b, 3};
      },
      [](double a, double b) {
        return Vec2{20 * a, 10 * b};
      });
}

}  // namespace

TEST_F(ShellTest, AbovePlanesPlacesAreThePoints) {
  const auto source = make_shell_source("plane", shell_above(plane_patch(), {1, 5}), {});
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random_point({0, 0, 4}, {20, 10, 8});
    EXPECT_NEAR(at(source, "u", p), p.x, 1e-12);
    EXPECT_NEAR(at(source, "v", p), p.y, 1e-12);
    EXPECT_NEAR(at(source, "height", p), p.z - 3, 1e-12);
    expect_near(slope(source, "u", p), {1, 0, 0}, 1e-12);
    expect_near(slope(source, "v", p), {0, 1, 0}, 1e-12);
    expect_near(slope(source, "height", p), {0, 0, 1}, 1e-12);
    EXPECT_LE(at(source, "outside", p), 0);
  }
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random_point({-5, -5, 0}, {25, 15, 12});
    const bool is_in = p.x >= 0 && p.x <= 20 && p.y >= 0 && p.y <= 10 && p.z >= 4 && p.z <= 8;
    EXPECT_EQ(at(source, "outside", p) <= 0, is_in);
    EXPECT_EQ(at(source, "inside", p), is_in ? 1 : 0);
    if (!is_in) continue;
    EXPECT_NEAR(at(source, "border", p), std::min({p.x, 20 - p.x, p.y, 10 - p.y}), 1e-12);
  }
  // The distance to the nearest side, where that is one of the four beside the plane.
  EXPECT_NEAR(at(source, "outside", {0.5, 5, 6}), -0.5, 1e-12);
  EXPECT_NEAR(at(source, "outside", {-0.5, 5, 6}), 0.5, 1e-12);
}

// Triangles between exact points of the cylinder deviate from it by the sagitta.
TEST_F(ShellTest, AboveCylindersPlacesAreArcsAndRadii) {
  constexpr uint32_t columns = 64;
  constexpr double radius = 10, angle = 2;
  const auto source =
      make_shell_source("cylinder", shell_above(cylinder_patch(radius, angle, 12, columns, 6), {0, 4}), {});
  const double sagitta = radius * (1 - std::cos(angle / columns / 2)) * 1.5;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 place = random_point({0.001, 0.001, 0.01}, {angle - 0.001, 11.999, 3.99});
    const double r = radius + place.z;
    const Vec3 p{r * std::cos(place.x), r * std::sin(place.x), place.y};
    EXPECT_NEAR(at(source, "u", p), radius * place.x, sagitta);
    EXPECT_NEAR(at(source, "v", p), place.y, 1e-9);
    EXPECT_NEAR(at(source, "height", p), place.z, sagitta);
    const Vec3 u = slope(source, "u", p), v = slope(source, "v", p), w = slope(source, "height", p);
    EXPECT_NEAR(dot(u, cross(v, w)), radius / r, 0.002) << "volume at radius " << r;
    expect_near(w, {std::cos(place.x), std::sin(place.x), 0}, 0.02);
  }
}

TEST_F(ShellTest, SlopesAreDerivatives) {
  SurfacePatch patch = grid_patch(
      6, 6,
      [](double a, double b) {
        return Vec3{10 * a, 10 * b, 2 * a * b + std::sin(3 * a)};
      },
      [](double a, double b) {
        return Vec2{11 * a + b, 9 * b};
      });
  const auto source = make_shell_source("bent", shell_above(std::move(patch), {0, 1}), {});
  constexpr double h = 1e-6;
  int tested = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random_point({0, 0, 0}, {10, 10, 4});
    if (at(source, "outside", p) > -0.01) continue;
    for (const char* of : {"u", "v", "height"}) {
      const auto change = [&](Vec3 by) { return (at(source, of, p + h * by) - at(source, of, p - h * by)) / (2 * h); };
      const Vec3 found{change({1, 0, 0}), change({0, 1, 0}), change({0, 0, 1})};
      // Slopes differ on both sides of an edge.
      if (length(slope(source, of, p + Vec3{h, h, h}) - slope(source, of, p - Vec3{h, h, h})) > 1e-5) continue;
      expect_near(slope(source, of, p), found, 1e-4);
      ++tested;
    }
  }
  EXPECT_GT(tested, 100);
}

TEST_F(ShellTest, RangesEncloseValues) {
  const auto source = make_shell_source("sphere",
                                        [] {
                                          SurfacePatch patch = sphere_patch(10, -0.5, 0.7, 12, 12);
                                          for (const Vec3& p : patch.points)
                                            patch.places.push_back({10 * std::atan2(p.y, p.x), p.z});
                                          return shell_above(std::move(patch), {0.5, 3});
                                        }(),
                                        {});
  for (int n = 0; n < 300; ++n) {
    const Vec3 low = random_point({-2, -2, -10}, {14, 14, 12});
    const double size = std::exp(random_point({-3, 0, 0}, {1.5, 1, 1}).x);
    const Box box{low, low + Vec3{size, size, size}};
    for (int channel = 0; channel < 15; ++channel) {
      const Interval range = source->range(channel, box);
      for (int k = 0; k < 10; ++k) {
        const double value = source->sample(channel, random_point(box.lo, box.hi));
        EXPECT_GE(value, range.lo) << channel;
        EXPECT_LE(value, range.hi) << channel;
      }
    }
  }
}

TEST_F(ShellTest, SamplesInRowsAreThoseOfSinglePoints) {
  const auto source = make_shell_source("cylinder", shell_above(cylinder_patch(10, 2, 12, 20, 6), {0, 4}), {});
  std::vector<Vec3> points;
  for (int n = 0; n < 400; ++n) points.push_back({-6 + 0.05 * n, 9, 6.02});
  for (int n = 0; n < 400; ++n) points.push_back(random_point({-16, -4, -4}, {16, 16, 16}));
  for (int n = 0; n < 200; ++n) points.push_back({0.01 * n, 10.5, 2.0 * (n % 8) - 2});  // along edges, and beyond
  std::vector<double> values(points.size());
  for (int channel = 0; channel < 15; ++channel) {
    source->sample_all(channel, points, values);
    for (size_t n = 0; n < points.size(); ++n) EXPECT_EQ(values[n], source->sample(channel, points[n]));
  }
}

// All instruction sets find the same places, to the last bit.
TEST_F(ShellTest, PlacesInRowsAreThoseOfThePrism) {
  const Shell shell = shell_above(sphere_patch(10, -0.5, 0.7, 6, 6), {0.5, 3});
  const Prisms prisms(shell);
  for (const PrismKernels& kernels : prism_kernels())
    for (size_t n = 0; n < prisms.count(); ++n) {
      PrismRow row{};
      std::array<PrismPlace, PrismRow::most> places;
      for (size_t i = 0; i < PrismRow::most; ++i) {
        const Vec3 shares = random_point({0.1, 0.1, 0.5}, {0.4, 0.4, 3});
        const Vec3 p = prisms[n].point({shares.x, shares.y, shares.z});
        row.x[i] = p.x;
        row.y[i] = p.y;
        row.z[i] = p.z;
        ASSERT_TRUE(prisms[n].find(p, prisms.heights(), places[i]));
      }
      row.x[11] += 30;
      ASSERT_EQ(kernels.places(prisms[n].numbers(), prisms.heights(), 1e-7, row, PrismRow::most), 11U);
      kernels.slopes(prisms[n].numbers(), row, 11);
      for (size_t i = 0; i < 11; ++i) {
        EXPECT_EQ(row.second[i], places[i].second);
        EXPECT_EQ(row.third[i], places[i].third);
        EXPECT_EQ(row.height[i], places[i].height);
        const Prism::Slopes slopes = prisms[n].slopes(places[i]);
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_EQ(row.slopes[static_cast<size_t>(axis)][i], slopes.second[axis]);
          EXPECT_EQ(row.slopes[static_cast<size_t>(3 + axis)][i], slopes.third[axis]);
          EXPECT_EQ(row.slopes[static_cast<size_t>(6 + axis)][i], slopes.height[axis]);
        }
      }
    }
}

// Inside of a cylinder, cells may be as high as its radius.
TEST_F(ShellTest, FoldsAreFoundWhereTheCentreOfCurvatureIs) {
  const auto fold = find_fold(shell_above(cylinder_patch(5, 2, 12, 40, 4), {0, 6}, -1));
  ASSERT_TRUE(fold);
  EXPECT_NEAR(fold->height, 5, 0.02);
  EXPECT_FALSE(find_fold(shell_above(cylinder_patch(5, 2, 12, 40, 4), {0, 4.9}, -1)));
  EXPECT_FALSE(find_fold(shell_above(cylinder_patch(5, 2, 12, 40, 4), {0, 40})));
  const auto in_sphere = find_fold(shell_above(sphere_patch(5, -0.5, 0.5, 20, 20), {0, 6}, -1));
  ASSERT_TRUE(in_sphere);
  EXPECT_NEAR(in_sphere->height, 5, 0.1);
}

// The legs of a U are 6 mm apart.
TEST_F(ShellTest, CellsThatReachAnotherPartOverlap) {
  const auto at_place = [](double a, double b) {
    const double s = a * 30;
    const double x = s < 12 ? 0 : s < 18 ? s - 12 : 6, z = s < 12 ? 12 - s : s < 18 ? 0 : s - 18;
    return Vec3{x, 10 * b, z};
  };
  const SurfacePatch u = grid_patch(60, 10, at_place);
  Shell low = shell_above(u, {0, 0.2}), high = shell_above(u, {0, 3.5});
  EXPECT_FALSE(find_overlap(low));
  EXPECT_TRUE(find_overlap(high));
}

// Areas above a sphere grow as the square of the radius.
TEST_F(ShellTest, ReportsGiveTheVolumesAboveASphere) {
  SurfacePatch patch = sphere_patch(10, -0.05, 0.05, 40, 4);
  for (const Vec3& p : patch.points) patch.places.push_back({10 * std::atan2(p.y, p.x), 10 * std::asin(p.z / 10)});
  const ShellReport report = report_of(shell_above(std::move(patch), {0, 5}));
  EXPECT_NEAR(report.volumes.lo, 1, 0.003);
  EXPECT_NEAR(report.volumes.hi, 2.25, 0.005);
  EXPECT_NEAR(report.stretches.hi, 1.5, 0.003);
  EXPECT_NEAR(report.aspect, 1, 0.005);
}

TEST_F(ShellTest, WaysEndWhereTheNormalMeetsTheOtherSurface) {
  const SurfacePatch plane = plane_patch();
  const SurfaceRays rays(plane.points, plane.triangles);
  expect_near(rays.way_from({5, 5, 1}, {0, 0, 1}), {0, 0, 2}, 1e-12);
  const double slanted = 1 / std::sqrt(2.0);
  expect_near(rays.way_from({5, 5, 1}, {slanted, 0, slanted}), {2, 0, 2}, 1e-12);
  expect_near(rays.way_from({-1, 5, 3}, {0, 0, 1}), {1, 0, 0}, 1e-12);  // misses
  EXPECT_NEAR(rays.distance({3, 3, 7}), 4, 1e-12);
}

TEST_F(ShellTest, PatchesAreChosenByDirectionBoxAndBend) {
  // A block of 10 x 10 x 10, two triangles a side.
  std::vector<Vec3> points;
  for (int n = 0; n < 8; ++n) points.push_back({n & 1 ? 10.0 : 0.0, n & 2 ? 10.0 : 0.0, n & 4 ? 10.0 : 0.0});
  const std::vector<Corners> block{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  EXPECT_NE(choose_patch(points, block, {}).problem.find("closed"), std::string::npos);
  PatchChoice top;
  top.normal = Vec3{0, 0, 1};
  ASSERT_EQ(choose_patch(points, block, top).patch.triangles.size(), 2u);
  PatchChoice linked;
  linked.at = Vec3{5, 5, 12};
  linked.angle_deg = 30;
  const ChosenPatch found = choose_patch(points, block, linked);
  ASSERT_EQ(found.patch.triangles.size(), 2u);
  for (const Vec3& p : found.patch.points) EXPECT_EQ(p.z, 10);
  for (const Vec3& n : found.patch.normals) expect_near(n, {0, 0, 1}, 1e-12);
  PatchChoice sides;
  sides.normal = Vec3{0, 0, 1};
  sides.within_deg = 100;
  EXPECT_EQ(choose_patch(points, block, sides).patch.triangles.size(), 10u);
  PatchChoice both;
  both.box = Box{{-1, -1, -1}, {11, 3.4, 11}};
  EXPECT_EQ(choose_patch(points, block, both).problem, "");
  PatchChoice none;
  none.box = Box{{20, 20, 20}, {21, 21, 21}};
  EXPECT_NE(choose_patch(points, block, none).problem.find("no triangle"), std::string::npos);
}

TEST_F(ShellTest, PlacesKeepTheAreaAndFollowADirection) {
  SurfacePatch patch = plane_patch();
  for (Vec2& place : patch.places) place = {-3 * place.y, 3 * place.x};  // turned by 90 degrees, and larger
  const Vec2 lengths = align_places(patch, {1, 0, 0});
  EXPECT_NEAR(lengths.x, 20, 1e-12);
  EXPECT_NEAR(lengths.y, 10, 1e-12);
  for (size_t n = 0; n < patch.points.size(); ++n) {
    EXPECT_NEAR(patch.places[n].x, patch.points[n].x, 1e-12);
    EXPECT_NEAR(patch.places[n].y, patch.points[n].y, 1e-12);
  }
  const Vec2 other = align_places(patch, {0, 1, 0});
  EXPECT_NEAR(other.x, 10, 1e-12);
  EXPECT_FALSE(turned_over(patch));
}

}  // namespace ombre::importing

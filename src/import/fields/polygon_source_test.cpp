#include "import/fields/polygon_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "import/fields/path_source.h"
#include "import/fields/polygon_walls.h"

namespace ombre::importing {
namespace {

constexpr int inside = 0, distance = 1;

Ring square(double half, Vec2 middle = {}) {
  return {{middle.x - half, middle.y - half},
          {middle.x + half, middle.y - half},
          {middle.x + half, middle.y + half},
          {middle.x - half, middle.y + half}};
}

// Returns a star polygon: points on a circle, each joined to the one `stride` further.
Ring star(double radius, size_t points, size_t stride) {
  Ring ring;
  for (size_t n = 0; n < points; ++n) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(n * stride) / static_cast<double>(points);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

Ring jagged(std::mt19937& random, size_t points) {
  std::uniform_real_distribution<double> radius(2, 9);
  Ring ring;
  for (size_t n = 0; n < points; ++n) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(points),
                 r = radius(random);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return ring;
}

Affine random_map(std::mt19937& random) {
  std::uniform_real_distribution<double> entry(-0.6, 0.6);
  Affine map;
  for (Vec3& row : map.rows) row = {entry(random), entry(random), entry(random)};
  map.offset = {10 * entry(random) - 8, 10 * entry(random) - 8, entry(random)};
  return map;
}

// Returns the number of voxels at which rows differ from sample(), not counting centres on a wall.
size_t count_differences(const program::FieldSource& source, const Affine& map, int64_t width, int64_t rows,
                         int64_t k) {
  const auto sampler = source.rows(inside, map);
  std::vector<std::vector<program::Span>> spans;
  sampler->layer(k, -2, rows, width, spans);
  size_t different = 0;
  for (int64_t j = -2; j < rows; ++j) {
    std::vector<bool> filled(static_cast<size_t>(width), false);
    int64_t last = -1;
    for (const program::Span& span : spans[static_cast<size_t>(j + 2)]) {
      EXPECT_TRUE(last < span.begin && span.begin < span.end && span.end <= width);
      last = span.end;
      for (int64_t i = span.begin; i < span.end; ++i) filled[static_cast<size_t>(i)] = true;
    }
    for (int64_t i = 0; i < width; ++i) {
      const Vec3 p = map({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
      if (std::abs(source.sample(distance, p)) < 1e-9) continue;
      different += filled[static_cast<size_t>(i)] != (source.sample(inside, p) == 1);
    }
  }
  return different;
}

}  // namespace

TEST(PolygonSource, KnowsDistancesToASquareWithAHole) {
  const auto source = make_polygon_source("s", {{square(5)}, {square(2)}});
  EXPECT_EQ(source->sample(distance, {0, 0, 7}), 2);
  EXPECT_EQ(source->sample(distance, {3.5, 0, 0}), -1.5);
  EXPECT_EQ(source->sample(distance, {2.25, 0, -3}), -0.25);
  EXPECT_EQ(source->sample(distance, {8, 9, 0}), 5);
  EXPECT_EQ(source->sample(inside, {0, 0, 0}), 0);
  EXPECT_EQ(source->sample(inside, {-4, 4, 1e9}), 1);
  EXPECT_EQ(source->bounds(), (Box{{-5, -5, -Box::inf}, {5, 5, Box::inf}}));
}

TEST(PolygonSource, TakesRingsOfEitherTurn) {
  Ring outer = square(5), hole = square(2);
  std::reverse(outer.begin(), outer.end());
  for (int n = 0; n < 2; ++n) {
    const auto source = make_polygon_source("s", {{outer}, {hole}});
    EXPECT_EQ(source->sample(distance, {3.5, 0, 0}), -1.5);
    EXPECT_EQ(source->sample(distance, {0, 0, 0}), 2);
    std::reverse(hole.begin(), hole.end());
  }
}

TEST(PolygonSource, HasNoWallsInsideOfAStar) {
  const double golden = (1 + std::sqrt(5)) / 2;
  const auto source = make_polygon_source("s", {{star(10, 5, 2)}, {}});
  // The notches of a pentagram lie on a circle smaller by the square of the golden ratio. Its crossing edges pass
  // closer to the centre, at cos 72 degrees of the radius.
  EXPECT_NEAR(source->sample(distance, {0, 0, 0}), -10 / (golden * golden), 1e-9);
  EXPECT_EQ(source->sample(inside, {0, 0, 0}), 1);
  EXPECT_EQ(source->sample(inside, {-9, 0, 0}), 0);
}

TEST(PolygonSource, HasNoWallsWhereRingsOverlap) {
  const auto source = make_polygon_source("s", {{square(3, {-2, 0}), square(3, {2, 0})}, {}});
  EXPECT_EQ(source->sample(distance, {0, 0, 0}), -3);
  EXPECT_NEAR(source->sample(distance, {1, 0.5, 0}), -2.5, 1e-12);
  // Two squares side by side share an edge.
  const auto pair = make_polygon_source("s", {{square(3, {-3, 0}), square(3, {3, 0})}, {}});
  EXPECT_EQ(pair->sample(distance, {0, 0.5, 0}), -2.5);
  EXPECT_EQ(pair->sample(distance, {0.5, 0, 0}), -3);
}

TEST(PolygonSource, CutsHolesThatOverlapAndReachOut) {
  const auto source = make_polygon_source("s", {{square(5)}, {square(2, {4, 0}), square(2, {5, 0})}});
  EXPECT_EQ(source->sample(inside, {4.5, 0, 0}), 0);
  EXPECT_EQ(source->sample(inside, {6.5, 0, 0}), 0);
  EXPECT_EQ(source->sample(distance, {0, 0, 0}), -2);
  EXPECT_EQ(source->sample(distance, {6.5, 0, 0}), 2.5);  // the nearest point is (5, 2)
}

TEST(PolygonSource, IsTheSameFarAway) {
  const Vec2 far{3e5, -7e5};
  const auto source = make_polygon_source("s", {{square(3, far), square(3, {far.x + 2, far.y})}, {square(1, far)}});
  EXPECT_NEAR(source->sample(distance, {far.x, far.y + 1.5, 0}), -0.5, 1e-9);
  EXPECT_NEAR(source->sample(distance, {far.x + 3, far.y, 0}), -2, 1e-9);
  EXPECT_NEAR(source->sample(distance, {far.x, far.y, 0}), 1, 1e-9);
}

TEST(PolygonSource, OpensWhereItTurns) {
  const Ring half{{0, -2}, {4, -2}, {4, 2}, {0, 2}};
  const auto flat = make_polygon_source("s", {{half}, {}}), turned = make_polygon_source("s", {{half}, {}}, {true});
  EXPECT_EQ(flat->sample(distance, {0.5, 0, 0}), -0.5);
  EXPECT_EQ(turned->sample(distance, {0.5, 0, 0}), -2);
  EXPECT_EQ(turned->sample(inside, {0, 0, 0}), 1);
  EXPECT_EQ(turned->sample(distance, {-3, 0, 0}), 3);
  EXPECT_NE(flat->content(), turned->content());
}

TEST(PolygonSource, RowsAgreeWithPointsInAnyPlacement) {
  std::mt19937 random(5);
  for (int round = 0; round < 40; ++round) {
    const auto source = make_polygon_source("s", {{jagged(random, 60), star(7, 7, 3)}, {star(4, 5, 2)}});
    EXPECT_EQ(count_differences(*source, random_map(random), 40, 30, round), 0u) << round;
  }
  const auto source = make_polygon_source("s", {{star(7, 7, 3)}, {}});
  EXPECT_EQ(count_differences(*source, Affine::translation({-8, -8, 0}) * Affine::scaling({0.37, 0.41, 1}), 45, 40, 0),
            0u);
  // Rows along z project to one point, even if the rotation is rounded.
  EXPECT_EQ(count_differences(*source, Affine::rotation({0, 1, 0}, 90), 20, 9, 2), 0u);
  Affine turned = Affine::rotation({0, 1, 0}, 90);
  turned.rows[0].x = 6e-17;
  EXPECT_EQ(count_differences(*source, turned, 20, 9, 2), 0u);
}

TEST(PolygonSource, RowsHaveTheArea) {
  std::mt19937 random(8);
  const Ring ring = jagged(random, 200);
  const auto source = make_polygon_source("s", {{ring}, {}});
  constexpr double pitch = 0.01;
  const auto sampler = source->rows(inside, Affine::translation({-9, -9, 0}) * Affine::scaling({pitch, pitch, 1}));
  std::vector<std::vector<program::Span>> rows;
  sampler->layer(0, 0, 1801, 1801, rows);
  double area = 0;
  for (const auto& row : rows)
    for (const program::Span& span : row) area += static_cast<double>(span.end - span.begin) * pitch * pitch;
  EXPECT_NEAR(area, doubled_area(ring) / 2, 0.002 * area);
}

TEST(PolygonSource, RangesHoldWhatPointsSay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-11, 11), part(0, 1);
  const auto source = make_polygon_source("s", {{jagged(random, 50)}, {square(1)}});
  size_t settled = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 lo{coordinate(random), coordinate(random), 0}, size{4 * part(random), 4 * part(random), 1};
    const Box box{lo, lo + size};
    const Interval holds = source->range(inside, box), far = source->range(distance, box);
    settled += holds.is_point();
    for (int i = 0; i < 10; ++i) {
      const Vec3 p = lo + Vec3{part(random) * size.x, part(random) * size.y, 0};
      EXPECT_TRUE(holds.contains(source->sample(inside, p)));
      EXPECT_TRUE(far.contains(source->sample(distance, p)));
    }
  }
  EXPECT_GT(settled, 600u);  // most boxes are far from the walls
}

TEST(PolygonSource, DistancesAreTheLeastOfAllEdges) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> coordinate(-12, 12);
  const Ring ring = jagged(random, 3000);
  const auto source = make_polygon_source("s", {{ring}, {}});
  for (int n = 0; n < 300; ++n) {
    const Vec3 p{coordinate(random), coordinate(random), 0};
    double best = Box::inf;
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      best = std::min(best, squared_distance(LineSegment{{a.x, a.y, 0}, {b.x, b.y, 0}}, p));
    }
    EXPECT_NEAR(std::abs(source->sample(distance, p)), std::sqrt(best), 1e-12);
  }
}

TEST(PolygonWalls, FindRingsThatCrossThemselves) {
  EXPECT_FALSE(find_self_crossing(square(3)));
  const Ring bow{{0, 0}, {4, 4}, {4, 0}, {0, 4}};
  ASSERT_TRUE(find_self_crossing(bow));
  EXPECT_EQ(*find_self_crossing(bow), (std::array<size_t, 2>{0, 2}));
  const Ring touching{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}};  // its fourth corner lies on an edge
  EXPECT_FALSE(find_self_crossing(touching));
}

// Points are near and far, on joints, where two segments are equally near, and not finite.
TEST(PathSource, ManyPointsAtOnceGetTheSameBits) {
  std::vector<Vec3> corners;
  for (int n = 0; n <= 60; ++n) corners.push_back({10 * std::cos(0.4 * n), 10 * std::sin(0.4 * n), 0.3 * n});
  for (const auto& source : {make_path_source(corners), make_points_source(corners),
                             make_path_source({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}})}) {
    std::vector<Vec3> points{corners[3], {0.5, 0.5, 0}, {0, 0, 1e6}, {NAN, 0, 0}};
    for (int k = 0; k < 9; ++k)
      for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 40; ++i) points.push_back({0.5 * i - 9, 0.7 * j - 6, 1.5 * k - 2});
    for (const int channel : {0, 1}) {
      std::vector<double> values(points.size());
      source->sample_all(channel, points, values);
      for (size_t n = 0; n < points.size(); ++n) {
        const double alone = source->sample(channel, points[n]);
        ASSERT_TRUE(values[n] == alone || (std::isnan(values[n]) && std::isnan(alone))) << n;
      }
    }
  }
}

TEST(PathSource, KnowsDistancesToLines) {
  const auto source = make_path_source({{0, 0, 0}, {10, 0, 0}, {10, 0, 5}});
  EXPECT_EQ(source->sample(0, {3, 4, 0}), 4);
  EXPECT_EQ(source->sample(0, {-3, 0, 4}), 5);
  EXPECT_EQ(source->sample(0, {10, 0, 2}), 0);
  EXPECT_EQ(source->sample(0, {13, 4, 5}), 5);
  EXPECT_EQ(source->bounds(), (Box{{0, 0, 0}, {10, 0, 5}}));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-15, 15), part(0, 1);
  for (int n = 0; n < 500; ++n) {
    const Vec3 lo{coordinate(random), coordinate(random), coordinate(random)}, size{part(random), part(random), 3};
    const Interval range = source->range(0, {lo, lo + size});
    const Vec3 p = lo + Vec3{part(random) * size.x, part(random) * size.y, part(random) * size.z};
    EXPECT_TRUE(range.contains(source->sample(0, p)));
    EXPECT_LE(range.hi - range.lo, length(size) + 1e-9);
  }
}

}  // namespace ombre::importing

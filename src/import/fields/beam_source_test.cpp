#include "import/fields/beam_source.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

#include "import/fields/beam_shape.h"
#include "import/fields/channels.h"
#include "import/fields/combined_source.h"
#include "import/fields/spans.h"
#include "import/surfaces/mesh_source.h"
#include "import/surfaces/test_meshes.h"

namespace ombre::importing {
namespace {

using formats::Beam;
using formats::BeamCap;
using formats::BeamLattice;
using formats::PlacedLattice;

constexpr double pi = std::numbers::pi;

double between(std::mt19937& random, double lo, double hi) {
  return lo + (hi - lo) * static_cast<double>(random()) / 4294967295.0;
}

Vec3 point_in(std::mt19937& random, double half) {
  return {between(random, -half, half), between(random, -half, half), between(random, -half, half)};
}

// Returns beams of all kinds and balls in a cube from -10 to 10.
BeamLattice scattered(uint32_t seed) {
  std::mt19937 random(seed);
  BeamLattice lattice;
  for (int n = 0; n < 30; ++n) lattice.vertices.push_back(point_in(random, 10));
  for (uint32_t n = 0; n + 1 < 30; ++n)
    lattice.beams.push_back({{n, n + 1},
                             {between(random, 0.2, 2), n % 3 == 0 ? 0.7 : between(random, 0.2, 2)},
                             {static_cast<BeamCap>(random() % 3), static_cast<BeamCap>(random() % 3)}});
  for (uint32_t n = 0; n < 5; ++n) lattice.balls.push_back({n, between(random, 0.5, 3)});
  return lattice;
}

PlacedLattice placed(BeamLattice lattice, const Affine& map = {}) {
  return {{}, std::make_shared<const BeamLattice>(std::move(lattice)), map};
}

program::SourceField source_of(const PlacedLattice& lattice) { return make_beam_source("a", lattice, Hash{}); }

PlacedLattice one_beam(double length, double r1, double r2, BeamCap cap1, BeamCap cap2) {
  BeamLattice lattice;
  lattice.vertices = {{0.3, 0.2, -0.1}, {0.3 + length, 0.2, -0.1}};
  lattice.beams = {{{0, 1}, {r1, r2}, {cap1, cap2}}};
  return placed(lattice);
}

// Returns the volume from voxels of 0.05 mm.
double volume_of(const program::FieldSource& source) {
  const double voxel = 0.05;
  const Box box = source.bounds();
  const Affine map =
      Affine::translation(box.lo + Vec3{voxel / 2, voxel / 2, voxel / 2}) * Affine::scaling({voxel, voxel, voxel});
  const Vec3 size = (1 / voxel) * box.size();
  const auto rows = source.rows(inside_channel, map);
  int64_t count = 0;
  std::vector<Spans> layer;
  for (int64_t k = 0; k <= static_cast<int64_t>(size.z); ++k) {
    rows->layer(k, 0, static_cast<int64_t>(size.y) + 1, static_cast<int64_t>(size.x) + 1, layer);
    for (const Spans& row : layer)
      for (const program::Span& span : row) count += span.end - span.begin;
  }
  return static_cast<double>(count) * voxel * voxel * voxel;
}

double frustum_volume(double length, double r1, double r2) { return pi * length * (r1 * r1 + r1 * r2 + r2 * r2) / 3; }

TEST(BeamSource, CapsMakeTheVolumesOfMathematics) {
  const double half_balls = 2.0 / 3 * pi * (2 * 2 * 2 + 1);
  const auto volume = [](BeamCap cap) { return volume_of(*source_of(one_beam(6, 2, 1, cap, cap))); };
  EXPECT_NEAR(volume(BeamCap::butt), frustum_volume(6, 2, 1), 0.1);
  EXPECT_NEAR(volume(BeamCap::hemisphere), frustum_volume(6, 2, 1) + half_balls, 0.1);
  // The ball at the thicker end is wider than the frustum as far as sqrt(4 - a^2) = 2 - a/6.
  const double meets = 24.0 / 37;
  const double beyond = pi * (4 * meets - meets * meets * meets / 3) - frustum_volume(meets, 2, 2 - meets / 6);
  EXPECT_NEAR(volume(BeamCap::sphere), frustum_volume(6, 2, 1) + half_balls + beyond, 0.1);
}

TEST(BeamSource, EachEndHasItsOwnCap) {
  const auto source = source_of(one_beam(6, 1, 1, BeamCap::butt, BeamCap::sphere));
  const auto holds = [&](double x) { return source->sample(inside_channel, {0.3 + x, 0.2, -0.1}) == 1; };
  EXPECT_FALSE(holds(-0.01));
  EXPECT_TRUE(holds(0));
  EXPECT_TRUE(holds(6.99));
  EXPECT_FALSE(holds(7.01));
}

// Checks that the rows of a lattice contain the same points as sample(), for a placement.
void expect_rows_of_points(const program::FieldSource& source, const program::RowSampler& rows,
                           const std::function<Vec3(Vec3)>& point) {
  std::vector<Spans> layer;
  int64_t held = 0;
  for (int64_t k = 0; k < 40; k += 3) {
    rows.layer(k, 5, 40, 40, layer);
    for (int64_t j = 5; j < 40; ++j) {
      std::vector<bool> row(40);
      for (const program::Span& span : layer[static_cast<size_t>(j - 5)])
        for (int64_t i = span.begin; i < span.end; ++i) row[static_cast<size_t>(i)] = true;
      for (int64_t i = 0; i < 40; ++i) {
        const Vec3 p = point({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        ASSERT_EQ(row[static_cast<size_t>(i)], source.sample(inside_channel, p) == 1) << i << ' ' << j << ' ' << k;
        held += row[static_cast<size_t>(i)] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(held, 500);
}

const Affine index_grid = Affine::translation({-11, -11, -11}) * Affine::scaling({0.57, 0.55, 0.56});

TEST(BeamSource, RowsAreThePoints) {
  for (uint32_t seed = 0; seed < 10; ++seed) {
    const auto source = source_of(placed(scattered(seed)));
    expect_rows_of_points(*source, *source->rows(inside_channel, index_grid), index_grid);
  }
}

TEST(BeamSource, RowsOfTurnedAndShearedLatticesAreThePoints) {
  const Affine shear{{Vec3{1, 0.4, 0}, Vec3{0, 0.8, 0.1}, Vec3{-0.3, 0, -1.1}}, {0.5, 0, 0}};
  const Affine map = shear * Affine::rotation({1, 2, 3}, 77);
  const auto source = source_of(placed(scattered(3), map));
  expect_rows_of_points(*source, *source->rows(inside_channel, index_grid), index_grid);
}

TEST(BeamSource, RaysAreThePoints) {
  const program::RayLattice rays{30, {-12, -12, -12}, {0.6, 0.6, 0.6}};
  for (uint32_t seed = 0; seed < 5; ++seed) {
    const auto source = source_of(placed(scattered(seed)));
    expect_rows_of_points(*source, *source->rays(inside_channel, rays, Affine{}), [&](Vec3 voxel) {
      const double depth = rays.first.x + voxel.x * rays.step.x, grown = 1 + depth / rays.eye_mm;
      return Vec3{depth, grown * (rays.first.y + voxel.y * rays.step.y),
                  grown * (rays.first.z + voxel.z * rays.step.z)};
    });
  }
}

// One row touches a beam's side, another runs along its axis.
TEST(BeamSource, RowsThatTouchHoldTheirPoints) {
  BeamLattice lattice;
  lattice.vertices = {{0, 0, 0}, {8, 0, 0}, {4, 0, 0}, {4, 0, 8}};
  lattice.beams = {{{0, 1}, {1, 1}, {BeamCap::butt, BeamCap::butt}}, {{2, 3}, {2, 2}, {BeamCap::butt, BeamCap::butt}}};
  const auto source = source_of(placed(lattice));
  const auto rows = source->rows(inside_channel, Affine{});
  std::vector<Spans> layer;
  rows->layer(0, 0, 3, 20, layer);
  EXPECT_EQ(layer[0], (Spans{{0, 9}}));
  EXPECT_EQ(layer[1], (Spans{{0, 9}}));
  EXPECT_EQ(layer[2], (Spans{{4, 5}}));
}

// Distances outside agree with a search over points of the beam on a grid, up to the grid's spacing.
TEST(BeamSource, DistancesOutsideAreExact) {
  std::mt19937 random(5);
  for (const BeamCap cap : {BeamCap::sphere, BeamCap::hemisphere, BeamCap::butt})
    for (const auto& [r1, r2] : {std::pair{2.0, 1.0}, {0.5, 1.5}, {1.0, 1.0}, {3.0, 0.2}}) {
      const BeamShape shape({0, 0, 0}, {2, 0, 0}, {r1, r2}, {cap, cap});
      for (int n = 0; n < 60; ++n) {
        const Vec3 p = point_in(random, 5);
        const double distance = shape.distance(p);
        if (distance <= 0) continue;
        // Searches in the half plane of the point, which by symmetry contains the nearest point.
        double least = 100;
        const double across = std::hypot(p.y, p.z);
        for (double x = -3.2; x < 5.2; x += 0.04)
          for (double r = 0; r < 3.2; r += 0.04)
            if (shape.distance({x, r, 0}) <= 0) least = std::min(least, std::hypot(x - p.x, r - across));
        ASSERT_NEAR(distance, least, 0.06);
      }
    }
}

TEST(BeamSource, DistancesInsideAreNotMoreThanTheDepth) {
  std::mt19937 random(6);
  for (uint32_t seed = 0; seed < 5; ++seed) {
    const auto source = source_of(placed(scattered(seed)));
    for (int n = 0; n < 2000; ++n) {
      const Vec3 p = point_in(random, 10), way = point_in(random, 1);
      const double distance = source->sample(distance_channel, p);
      if (distance > 0 || length(way) == 0) continue;
      const Vec3 near = p + (-0.999 * distance / length(way)) * way;
      ASSERT_LE(source->sample(distance_channel, near), 1e-9);
    }
  }
}

TEST(BeamSource, RangesHoldAllValues) {
  std::mt19937 random(7);
  const Affine map = Affine::scaling({1, 0.5, 2}) * Affine::rotation({1, 0, 1}, 30);
  const auto source = source_of(placed(scattered(1), map));
  for (int n = 0; n < 600; ++n) {
    const Vec3 center = point_in(random, 12), half{between(random, 0, 2), between(random, 0, 2), between(random, 0, 2)};
    const Box box{center - half, center + half};
    const Vec3 p{between(random, box.lo.x, box.hi.x), between(random, box.lo.y, box.hi.y),
                 between(random, box.lo.z, box.hi.z)};
    for (const int channel : {inside_channel, distance_channel})
      ASSERT_TRUE(source->range(channel, box).contains(source->sample(channel, p))) << n;
  }
}

TEST(BeamSource, EvenScalingKeepsDistancesExact) {
  const Affine map = Affine::scaling({-3, 3, 3}) * Affine::rotation({0, 1, 0}, 40);
  const PlacedLattice beam = one_beam(6, 2, 1, BeamCap::sphere, BeamCap::butt);
  const auto small = source_of(beam), large = source_of(placed(*beam.lattice, map));
  std::mt19937 random(8);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = point_in(random, 10);
    EXPECT_NEAR(large->sample(distance_channel, map(p)), 3 * small->sample(distance_channel, p), 1e-9);
  }
}

// Returns a ball with a radius of 3 mm.
program::SourceField ball_source() {
  BeamLattice lattice;
  lattice.vertices = {{0, 0, 0}};
  lattice.balls = {{0, 3}};
  return source_of(placed(lattice));
}

// The ball lies half in a cuboid.
TEST(CombinedSource, ClipsAndUnites) {
  const auto ball = ball_source();
  const auto cuboid = make_mesh_source("b", test::cuboid({0, -4, -4}, {4, 4, 4}), Hash{});
  const double whole = 36 * pi;
  EXPECT_NEAR(volume_of(*make_clipped_source(ball, cuboid, true)), whole / 2, 0.5);
  EXPECT_NEAR(volume_of(*make_clipped_source(ball, cuboid, false)), whole / 2, 0.5);
  EXPECT_NEAR(volume_of(*make_union_source({ball, cuboid})), 256 + whole / 2, 1);
  for (const auto& source : {make_clipped_source(ball, cuboid, true), make_clipped_source(ball, cuboid, false),
                             make_union_source({ball, cuboid})})
    expect_rows_of_points(
        *source,
        *source->rows(inside_channel, Affine::translation({-5, -5, -5}) * Affine::scaling({0.251, 0.251, 0.251})),
        Affine::translation({-5, -5, -5}) * Affine::scaling({0.251, 0.251, 0.251}));
}

TEST(CombinedSource, DistancesHaveTheRightSign) {
  const auto ball = ball_source();
  const auto cuboid = make_mesh_source("b", test::cuboid({0, -4, -4}, {4, 4, 4}), Hash{});
  if (cuboid->channel("distance") < 0) GTEST_SKIP() << "this build has no distances to meshes";
  const auto at = [](const program::SourceField& source, double x) {
    return source->sample(distance_channel, {x, 0, 0});
  };
  const auto inside = make_clipped_source(ball, cuboid, true), outside = make_clipped_source(ball, cuboid, false);
  EXPECT_DOUBLE_EQ(at(inside, -1), 1);
  EXPECT_DOUBLE_EQ(at(inside, 1), -1);
  EXPECT_DOUBLE_EQ(at(outside, -1), -1);
  EXPECT_DOUBLE_EQ(at(outside, 1), 1);
  EXPECT_DOUBLE_EQ(at(make_union_source({ball, cuboid}), -4), 1);
}

}  // namespace
}  // namespace ombre::importing

#include "import/fields/volume_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ombre::importing {
namespace {

constexpr std::array<int64_t, 3> size_of_grid{7, 5, 6};

template <class T, class F>
VolumeSource grid_of(const F& value) {
  std::vector<T> values;
  for (int64_t k = 0; k < size_of_grid[2]; ++k)
    for (int64_t j = 0; j < size_of_grid[1]; ++j)
      for (int64_t i = 0; i < size_of_grid[0]; ++i) values.push_back(static_cast<T>(value(i, j, k)));
  formats::VoxelVolume volume;
  volume.count = size_of_grid;
  volume.values = std::move(values);
  return make_volume_source("grid", std::move(volume), {});
}

// Returns the value of a voxel: no two are equal, and neighbours are not in order.
int64_t scattered_number(int64_t i, int64_t j, int64_t k) { return (i * 61 + j * 17 + k * 131) % 251; }

Vec3 somewhere(std::mt19937& random) {
  std::uniform_real_distribution<double> along(-2, 8);
  return {along(random), along(random), along(random)};
}

}  // namespace

// A function that is linear along each axis is reproduced exactly between centres.
TEST(VolumeSource, InterpolatesTrilinearly) {
  const auto f = [](double x, double y, double z) { return 3 + 2 * x - y + 4 * z + x * y - 0.5 * x * y * z; };
  const auto volume = grid_of<double>([&](auto i, auto j, auto k) {
    return f(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  });
  std::mt19937 random(1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p = somewhere(random);
    const double x = std::clamp(p.x, 0.0, 6.0), y = std::clamp(p.y, 0.0, 4.0), z = std::clamp(p.z, 0.0, 5.0);
    ASSERT_NEAR(volume.source->sample(0, p), f(x, y, z), 1e-12);
  }
  EXPECT_TRUE(std::isnan(volume.source->sample(0, {std::nan(""), 0, 0})));
}

// Keys's cubic convolution reproduces quadratic polynomials and their slopes at places with four voxels around them.
TEST(VolumeSource, CubicValuesAndSlopesOfQuadraticsAreExact) {
  const auto f = [](double x, double y, double z) { return 3 + x * x - 2 * x * y + 0.5 * z * z + y - 4 * z * x; };
  const auto volume = grid_of<double>([&](auto i, auto j, auto k) {
    return f(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  });
  const auto& source = *volume.source;
  const int cubic = source.channel("cubic"), x = source.channel("cubic_x"), y = source.channel("cubic_y"),
            z = source.channel("cubic_z");
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0, 1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 p{1 + 4 * share(random), 1 + 2 * share(random), 1 + 3 * share(random)};
    ASSERT_NEAR(source.sample(cubic, p), f(p.x, p.y, p.z), 1e-10);
    ASSERT_NEAR(source.sample(x, p), 2 * p.x - 2 * p.y - 4 * p.z, 1e-10);
    ASSERT_NEAR(source.sample(y, p), -2 * p.x + 1, 1e-10);
    ASSERT_NEAR(source.sample(z, p), p.z - 4 * p.x, 1e-10);
  }
}

TEST(VolumeSource, CubicValuesPassThroughVoxelsWithoutEdges) {
  const auto volume = grid_of<int16_t>(scattered_number);
  const auto& source = *volume.source;
  const int cubic = source.channel("cubic");
  EXPECT_EQ(source.sample(cubic, {3, 2, 4}), static_cast<double>(scattered_number(3, 2, 4)));
  constexpr double step = 1e-6;
  std::mt19937 random(5);
  for (int n = 0; n < 300; ++n) {
    Vec3 p = somewhere(random);
    p.x = std::round(p.x);  // where pieces of the spline meet
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 before = p, after = p;
      before[axis] -= step;
      after[axis] += step;
      const double slope = (source.sample(cubic, after) - source.sample(cubic, before)) / (2 * step);
      ASSERT_NEAR(source.sample(cubic + 1 + axis, p), slope, 1e-2);
    }
  }
}

TEST(VolumeSource, ManyPointsGiveTheBitsOfEach) {
  const auto volume = grid_of<int16_t>(scattered_number);
  std::mt19937 random(6);
  std::vector<Vec3> points;
  for (int n = 0; n < 40; ++n) {
    const Vec3 begin = somewhere(random);
    for (int m = 0; m < 30; ++m) points.push_back({begin.x + 0.37 * m - 4, begin.y, begin.z});
  }
  points.push_back({std::nan(""), 1, 2});
  points.push_back({1, std::nan(""), 2});
  for (int n = 0; n < 100; ++n) points.push_back(somewhere(random));
  for (const int channel : {0, 1, 2}) {
    std::vector<double> values(points.size());
    volume.source->sample_all(channel, points, values);
    for (size_t n = 0; n < points.size(); ++n) {
      const double alone = volume.source->sample(channel, points[n]);
      ASSERT_TRUE(values[n] == alone || (std::isnan(alone) && std::isnan(values[n]))) << n;
    }
  }
}

TEST(VolumeSource, NearestIsTheVoxelThatHoldsAPoint) {
  const auto volume = grid_of<uint8_t>(scattered_number);
  EXPECT_EQ(volume.source->sample(1, {2.4, 0.6, 4.9}), static_cast<double>(scattered_number(2, 1, 5)));
  EXPECT_EQ(volume.source->sample(1, {2.5, -9, 99}), static_cast<double>(scattered_number(3, 0, 5)));
}

TEST(VolumeSource, RangesHoldAllValues) {
  const auto volume = grid_of<int32_t>(scattered_number);
  std::mt19937 random(2);
  for (int n = 0; n < 300; ++n) {
    const Vec3 a = somewhere(random), b = somewhere(random);
    const Box box = hull(Box{a, a}, Box{b, b});
    for (const int channel : {0, 1, 2, 3, 4, 5}) {
      const Interval range = volume.source->range(channel, box);
      for (int m = 0; m < 20; ++m) {
        std::uniform_real_distribution<double> share(0, 1);
        const Vec3 size = box.size();
        const Vec3 p = box.lo + Vec3{share(random) * size.x, share(random) * size.y, share(random) * size.z};
        ASSERT_TRUE(range.contains(volume.source->sample(channel, p)));
      }
    }
  }
}

TEST(VolumeSource, RowsOnCentresAreCopies) {
  const auto volume = grid_of<uint16_t>(scattered_number);
  const Affine copies = Affine::translation({2, -1, 3});
  const Affine far_away = Affine::translation({100, 0, 0}), far_before = Affine::translation({-100, 0, 0});
  const Affine mirrored{{Vec3{-1, 0, 0}, Vec3{0, 0, 2}, Vec3{0, 1, 0}}, {6, 0, 0}};
  for (const Affine& map : {copies, far_away, far_before, mirrored})
    for (const int channel : {0, 1, 2}) {
      const auto rows = volume.source->rows(channel, map);
      ASSERT_TRUE(rows && rows->has_values());
      for (int64_t k = 0; k < 4; ++k)
        for (int64_t j = 0; j < 4; ++j) {
          std::array<float, 9> values{};
          rows->values(-1, j, k, values);
          const Interval range = rows->range({{-1, j, k}, {8, j + 1, k + 1}});
          for (size_t n = 0; n < values.size(); ++n) {
            const Vec3 p{static_cast<double>(n) - 1, static_cast<double>(j), static_cast<double>(k)};
            ASSERT_EQ(values[n], volume.source->sample(channel, map(p)));
            ASSERT_TRUE(range.contains(values[n]));
          }
        }
    }
}

TEST(VolumeSource, RowsBesideCentresOrBeyondFloatsAreQueriedPointByPoint) {
  EXPECT_FALSE(grid_of<uint16_t>(scattered_number).source->rows(0, Affine::translation({0.25, 0, 0})));
  EXPECT_FALSE(grid_of<uint16_t>(scattered_number).source->rows(0, Affine::scaling({0.5, 1, 1})));
  EXPECT_FALSE(grid_of<uint16_t>(scattered_number).source->rows(3, Affine{}));
  EXPECT_FALSE(grid_of<double>(scattered_number).source->rows(0, Affine{}));
  const auto large = grid_of<uint32_t>([](auto i, auto, auto) { return i == 0 ? (1 << 24) + 1 : 0; });
  EXPECT_FALSE(large.source->rows(0, Affine{}));
  EXPECT_TRUE(grid_of<float>(scattered_number).source->rows(0, Affine{}));
}

TEST(VolumeSource, PlacesEncloseWhereValuesReach) {
  const auto volume = grid_of<float>([](auto i, auto j, auto k) { return i == 5 && j == 2 && k == 4 ? 10 : 0; });
  const Box box = volume.places(0, {5, 10});
  std::mt19937 random(3);
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 p = somewhere(random);
    const bool reaches = volume.source->bounds().contains(p) && volume.source->sample(0, p) >= 5;
    ASSERT_TRUE(!reaches || box.contains(p));
  }
  const Box cubic = volume.places(2, {10.5, 20});
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 p = somewhere(random);
    const bool reaches = volume.source->bounds().contains(p) && volume.source->sample(2, p) >= 10.5;
    ASSERT_TRUE(!reaches || cubic.contains(p));
  }
  EXPECT_FALSE(box.contains({0, 2, 4}));
  EXPECT_TRUE(volume.places(0, {11, 12}).is_empty());
}

}  // namespace ombre::importing

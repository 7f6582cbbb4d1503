// Compares surfaces joined at equal shares of u and v with boxes and pipes.
#include "import/charts/paired_places.h"

#include <gtest/gtest.h>

#include <random>

#include "import/charts/test_patches.h"

namespace ombre::importing {
namespace {

// A rectangle of 6 x 4 mm at a height, whose places are given by shares of x and y.
SurfacePatch rectangle(double z, uint32_t columns, uint32_t rows, const std::function<Vec2(double, double)>& place) {
  return grid_patch(
      columns, rows,
      [=](double a, double b) {
        return Vec3{6 * a, 4 * b, z};
      },
      place);
}
SurfacePatch plain_rectangle(double z, uint32_t columns, uint32_t rows) {
  return rectangle(z, columns, rows, [](double a, double b) { return Vec2{6 * a, 4 * b}; });
}

Shell between(SurfacePatch patch, const PairedPlaces& pairs) {
  Shell shell{std::move(patch), {}, {0, 1}};
  for (size_t n = 0; n < shell.patch.points.size(); ++n)
    shell.ways.push_back(pairs.partner(shell.patch.places[n]) - shell.patch.points[n]);
  return shell;
}

double sample(const program::SourceField& source, const char* channel, Vec3 p) {
  return source->sample(source->channel(channel), p);
}

}  // namespace

TEST(PairedPlaces, OfParallelPlanesMakeABox) {
  const SurfacePatch low = plain_rectangle(1, 5, 3);
  // The other rectangle's u runs against y, its v against x, in other triangles and another scale.
  const SurfacePatch high = rectangle(3, 4, 7, [](double, double) { return Vec2{}; });
  SurfacePatch turned = high;
  turned.places.clear();
  for (const Vec3 p : turned.points) turned.places.push_back({8 - 2 * p.y, 3 - p.x / 2});
  const PairedPlaces pairs(turned, {6, 4}, {8, 3}, "nearest", low);
  EXPECT_FALSE(pairs.without_partner());
  EXPECT_NEAR(pairs.farthest_off(), 0, 1e-12);
  const Shell shell = between(low, pairs);
  EXPECT_FALSE(find_fold(shell));
  const ShellReport report = report_of(shell);
  EXPECT_NEAR(report.volumes.lo, 2, 1e-12);  // the height of a share of the way
  EXPECT_NEAR(report.volumes.hi, 2, 1e-12);
  EXPECT_NEAR(report.aspect, 1, 1e-9);
  const auto source = make_shell_source("box", shell, {});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.01, 0.99);
  for (int n = 0; n < 100; ++n) {
    const Vec3 p{6 * share(random), 4 * share(random), 1 + 2 * share(random)};
    EXPECT_NEAR(sample(source, "u", p), p.x, 1e-9);
    EXPECT_NEAR(sample(source, "v", p), p.y, 1e-9);
    EXPECT_NEAR(sample(source, "height", p), (p.z - 1) / 2, 1e-9);
    EXPECT_NEAR(sample(source, "height_z", p), 0.5, 1e-9);
  }
}

// At the radius r a cell has the volume r/5 * 3 per mm along u, mm along v and share of the way of 3 mm.
TEST(PairedPlaces, OfCylindersMakeAPipe) {
  const SurfacePatch inner = cylinder_patch(5, 1.5, 7, 60, 3);
  const SurfacePatch outer = cylinder_patch(8, 1.5, 7, 90, 2);
  const PairedPlaces pairs(outer, {7.5, 7}, {12, 7}, "nearest", inner);
  const Shell shell = between(inner, pairs);
  const auto source = make_shell_source("pipe", shell, {});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.02, 0.98);
  for (int n = 0; n < 100; ++n) {
    const double angle = 1.5 * share(random), r = 5 + 3 * share(random), z = 7 * share(random);
    const Vec3 p{r * std::cos(angle), r * std::sin(angle), z};
    EXPECT_NEAR(sample(source, "u", p), 5 * angle, 2e-3);
    EXPECT_NEAR(sample(source, "v", p), z, 1e-9);
    EXPECT_NEAR(sample(source, "height", p), (r - 5) / 3, 2e-3);
  }
  const ShellReport report = report_of(shell);
  EXPECT_NEAR(report.volumes.lo, 3, 0.01);
  EXPECT_NEAR(report.volumes.hi, 3 * 8 / 5.0, 0.01);
}

TEST(PairedPlaces, RunAlongTheNamedDirections) {
  const Vec2 share{0.2, 0.3};
  const std::vector<std::pair<const char*, Vec2>> expected{
      {"uv", {0.2, 0.3}}, {"uv_flip_u", {0.8, 0.3}}, {"uv_flip_v", {0.2, 0.7}}, {"uv_flip_both", {0.8, 0.7}},
      {"vu", {0.3, 0.2}}, {"vu_flip_u", {0.3, 0.8}}, {"vu_flip_v", {0.7, 0.2}}, {"vu_flip_both", {0.7, 0.8}}};
  for (const auto& [name, other] : expected) {
    const Vec2 found = pairing_called(name).share(share);
    EXPECT_NEAR(found.x, other.x, 1e-15) << name;
    EXPECT_NEAR(found.y, other.y, 1e-15) << name;
  }
}

// A rectangle that is paired with itself turned over has cells of no size along a line: a fold in the middle.
TEST(PairedPlaces, ThatCrossFold) {
  const SurfacePatch low = plain_rectangle(0, 6, 4), high = plain_rectangle(2, 6, 4);
  const PairedPlaces pairs(high, {6, 4}, {6, 4}, "uv_flip_u", low);
  const auto fold = find_fold(between(low, pairs));
  ASSERT_TRUE(fold);
  EXPECT_NEAR(fold->height, 0.5, 1e-3);
}

TEST(PairedPlaces, OfOutlinesThatDifferAreFound) {
  const SurfacePatch low = plain_rectangle(0, 6, 4);
  SurfacePatch half = plain_rectangle(2, 6, 4);
  std::erase_if(half.triangles, [&](const Corners& t) {
    const Vec3 middle = (1.0 / 3) * (half.points[t[0]] + half.points[t[1]] + half.points[t[2]]);
    return middle.x > 4 && middle.y > 2;
  });
  const PairedPlaces pairs(half, {6, 4}, {6, 4}, "uv", low);
  ASSERT_TRUE(pairs.without_partner());
  EXPECT_GT(pairs.without_partner()->x, 4);
  EXPECT_GT(pairs.without_partner()->y, 2);
  EXPECT_NEAR(pairs.farthest_off(), 2, 1e-9);
}

}  // namespace ombre::importing

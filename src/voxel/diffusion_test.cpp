#include "voxel/diffusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "voxel/test_spectrum.h"

namespace ombre::voxel {
namespace {

constexpr int64_t whole = 65536;

// Fractions at a voxel in 1/65536; empty outside.
using Composition = std::function<std::vector<int64_t>(int64_t i, int64_t j)>;

struct Layer {
  int64_t width = 0, height = 0;
  size_t materials = 0;
  std::vector<int> chosen;           // -1 outside
  std::vector<int64_t> missing;      // fractions minus voxels, in 1/65536
  std::vector<int64_t> carried;      // the same as the diffuser reports it
  std::vector<int64_t> least_share;  // least fraction of each material where it was chosen

  int at(int64_t i, int64_t j) const { return chosen[static_cast<size_t>(j * width + i)]; }
};

Layer diffuse(int64_t width, int64_t height, size_t materials, const Composition& composition, int64_t k = 0,
              uint64_t seed = 0) {
  Layer layer{
      width, height, materials, {}, std::vector<int64_t>(materials), {}, std::vector<int64_t>(materials, whole)};
  LayerDiffuser diffuser(width, materials, seed, k);
  for (int64_t j = 0; j < height; ++j) {
    std::vector<uint8_t> inside(static_cast<size_t>(width)), inside_next(inside.size()), chosen(inside.size());
    std::vector<std::vector<float>> fractions(materials, std::vector<float>(inside.size()));
    std::vector<const float*> pointers;
    for (const auto& values : fractions) pointers.push_back(values.data());
    for (size_t i = 0; i < inside.size(); ++i) {
      const std::vector<int64_t> parts = composition(static_cast<int64_t>(i), j);
      inside[i] = parts.empty() ? 0 : 1;
      inside_next[i] = j + 1 == height || composition(static_cast<int64_t>(i), j + 1).empty() ? 0 : 1;
      for (size_t m = 0; m < parts.size(); ++m) fractions[m][i] = static_cast<float>(parts[m]) / whole;
    }
    diffuser.row(j, inside, inside_next, pointers, chosen);
    for (size_t i = 0; i < inside.size(); ++i) {
      const std::vector<int64_t> parts = composition(static_cast<int64_t>(i), j);
      layer.chosen.push_back(inside[i] ? chosen[i] : -1);
      if (!inside[i]) continue;
      for (size_t m = 0; m < materials; ++m) layer.missing[m] += parts[m];
      layer.missing[chosen[i]] -= whole;
      layer.least_share[chosen[i]] = std::min(layer.least_share[chosen[i]], parts[chosen[i]]);
    }
  }
  layer.carried = diffuser.carried();
  return layer;
}

// Returns two materials, the first with this fraction everywhere.
Composition even(double fraction) {
  const int64_t first = std::llround(fraction * whole);
  return [=](int64_t, int64_t) { return std::vector<int64_t>{first, whole - first}; };
}

// Returns five materials in a ring, graded around it and pure in places.
std::vector<int64_t> ring(int64_t i, int64_t j) {
  const double x = static_cast<double>(i) - 60, y = static_cast<double>(j) - 60;
  if (std::hypot(x, y) > 55 || std::hypot(x, y) < 20) return {};
  const double turn = 5 * (std::atan2(y, x) / (2 * std::numbers::pi) + 0.5);
  std::vector<int64_t> parts(5);
  const auto first = static_cast<size_t>(turn) % 5;
  parts[(first + 1) % 5] = std::llround(std::clamp(1.2 * (turn - std::floor(turn)), 0.0, 1.0) * whole);
  parts[first] = whole - parts[(first + 1) % 5];
  return parts;
}

SquarePattern square(const Layer& layer, int64_t left, int64_t top) {
  return {64, [&, left, top](int64_t i, int64_t j) { return layer.at(left + i, top + j) == 0; }};
}

}  // namespace

TEST(Diffusion, OneMaterialIsThatMaterial) {
  const Layer layer = diffuse(50, 20, 1, [](int64_t, int64_t) { return std::vector<int64_t>{whole}; });
  for (const int chosen : layer.chosen) EXPECT_EQ(chosen, 0);
  EXPECT_EQ(layer.carried, (std::vector<int64_t>{0}));
}

TEST(Diffusion, NothingIsLostButWhatIsCarried) {
  for (const double fraction : {1.0 / whole, 0.02, 0.1, 1.0 / 3, 0.5, 0.9}) {
    const Layer layer = diffuse(300, 200, 2, even(fraction));
    EXPECT_EQ(layer.missing, layer.carried) << fraction;
    // The error is at most one voxel for each voxel of the last row: errors are means of errors, and none exceeds one.
    EXPECT_LE(std::abs(layer.carried[0]), 300 * whole) << fraction;
  }
  const Layer five = diffuse(121, 121, 5, ring);
  EXPECT_EQ(five.missing, five.carried);
  int64_t sum = 0;
  for (const int64_t carried : five.carried) sum += carried;
  EXPECT_EQ(sum, 0);
}

TEST(Diffusion, OnlyMaterialsOfAVoxelAreChosen) {
  const Layer layer = diffuse(121, 121, 5, ring);
  for (size_t m = 0; m < 5; ++m) {
    EXPECT_GT(layer.least_share[m], 0) << m;
    EXPECT_LT(layer.least_share[m], whole) << m;
  }
}

TEST(Diffusion, SingleVoxelsKeepTheFractionTogether) {
  // The struts are single voxels without neighbours. The error of one goes to the next ones.
  const Layer layer = diffuse(200, 200, 2, [](int64_t i, int64_t j) {
    return i % 2 == 0 && j % 2 == 0 ? std::vector<int64_t>{whole / 4, 3 * whole / 4} : std::vector<int64_t>{};
  });
  EXPECT_EQ(layer.missing, layer.carried);
  // The error is at most 2 of 10,000 voxels; independent draws would have a standard deviation of 43.
  EXPECT_LE(std::abs(layer.missing[0]), 2 * whole);
}

TEST(Diffusion, ThinWallsKeepTheFraction) {
  for (const bool along_x : {true, false}) {
    const Layer layer = diffuse(200, 200, 2, [=](int64_t i, int64_t j) {
      return (along_x ? j : i) == 7 ? std::vector<int64_t>{whole / 4, 3 * whole / 4} : std::vector<int64_t>{};
    });
    EXPECT_EQ(layer.missing, layer.carried);
    EXPECT_LE(std::abs(layer.missing[0]), whole);
  }
}

TEST(Diffusion, LayersAreBlue) {
  for (const double fraction : {0.1, 0.25, 0.5, 0.75}) {
    std::vector<SquarePattern> squares;
    double variance = 0;
    for (int64_t k = 0; k < 8; ++k) {
      squares.push_back(square(diffuse(128, 128, 2, even(fraction), k), 32, 32));
      variance += patch_variance(squares.back(), 16, fraction) / 8;
    }
    EXPECT_LT(Spectrum(squares, fraction).low(), 0.1) << fraction;
    EXPECT_LT(variance, 0.125) << fraction;
  }
}

TEST(Diffusion, MixturesBeginAtTheEdge) {
  // The first 16 rows keep the fraction within four standard deviations of independent draws.
  for (const double fraction : {0.02, 0.1, 1.0 / 3, 0.98}) {
    const Layer layer = diffuse(256, 16, 2, even(fraction));
    const double voxels = 256 * 16;
    EXPECT_LT(std::abs(static_cast<double>(layer.missing[0]) / whole),
              4 * std::sqrt(voxels * fraction * (1 - fraction)))
        << fraction;
    EXPECT_LT(std::abs(static_cast<double>(layer.missing[0]) / whole), voxels * fraction / 4) << fraction;
  }
}

TEST(Diffusion, LayersDoNotRepeatEachOther) {
  const Layer one = diffuse(128, 128, 2, even(0.25), 0), again = diffuse(128, 128, 2, even(0.25), 0),
              above = diffuse(128, 128, 2, even(0.25), 1), other = diffuse(128, 128, 2, even(0.25), 0, 1);
  EXPECT_EQ(one.chosen, again.chosen);
  EXPECT_NE(one.chosen, other.chosen);
  double sum = 0;
  for (size_t n = 0; n < one.chosen.size(); ++n) sum += (one.chosen[n] - 0.75) * (above.chosen[n] - 0.75);
  EXPECT_LT(sum / static_cast<double>(one.chosen.size()) / (0.25 * 0.75), 0.1);
}

}  // namespace ombre::voxel

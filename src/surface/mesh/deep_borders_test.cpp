#include "surface/mesh/deep_borders.h"

#include <gtest/gtest.h>

#include "program/field.h"

namespace ombre::surface {
namespace {

using program::Builder;
using program::Field;

constexpr double slope = 0.05;  // slope of the walls, relative to the middle plane of the valley

// Returns a solid with a valley along y whose bottom is at height 0, or the fin that would fill the valley.
Partition wedge(bool is_fin) {
  Builder builder;
  const Field is_wedge = less(abs(builder.input(0)), builder.input(2) * slope);
  const Field is_solid = is_fin ? is_wedge : logical_not(is_wedge);
  Partition partition;
  partition.label = builder.finish({{"region", select(is_solid, builder.constant(1), builder.constant(0))}});
  return partition;
}

}  // namespace

TEST(DeepBorders, AreTheGroundsOfValleysAndTheEdgesOfFins) {
  constexpr double reach = 0.1;
  for (const bool is_fin : {false, true}) {
    const Partition partition = wedge(is_fin);
    // Heights of the samples above the bottom. The last two are not found: one is too high, one so near that no search
    // is needed.
    const std::vector<double> heights = {0.11, 0.25, 0.39, 0.6, 0.05};
    std::vector<SurfaceSample> samples;
    for (const double height : heights) samples.push_back({{0, 1, height}, {0, 0, 1}});
    const FarSamples found = find_far_samples(partition, samples, reach, 1);
    EXPECT_EQ(found.far, std::vector<uint32_t>());
    EXPECT_EQ(found.beside, (std::vector<uint32_t>{0, 1, 2, 3}));
    const std::vector<DeepBorder> borders = find_deep_borders(partition, samples, found.beside, reach, 1);
    ASSERT_EQ(borders.size(), 3U);
    for (uint32_t n = 0; n < borders.size(); ++n) {
      EXPECT_EQ(borders[n].sample, n);
      EXPECT_LE(length(borders[n].at - Vec3{0, 1, 0}), 0.02 * reach) << heights[n];
    }
  }
}

}  // namespace ombre::surface

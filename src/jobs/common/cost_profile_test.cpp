#include "jobs/common/cost_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "jobs/slice/forecast.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

// Four thousand layers in slabs of four.
constexpr LayerRange all{0, 4000};
std::vector<LayerRange> slabs() { return missing_slabs(all, {}, 4); }

// Returns the cost of a shape whose layers take `of(height)` seconds and as many bytes; heights are 0 ... 1.
template <class F>
LayerCost cost(LayerRange slab, const F& of) {
  LayerCost sum;
  for (int64_t layer = slab.begin; layer < slab.end; ++layer) {
    const double one = of((static_cast<double>(layer) + 0.5) / 4000);
    sum.seconds += one;
    sum.bytes += one;
  }
  return sum;
}

double plate(double) { return 1; }
double cone(double height) { return (1 - height) * (1 - height); }
double ball(double height) { return 4 * height * (1 - height); }

}  // namespace

TEST(CostProfile, IsExactWhereCostsGrowEvenly) {
  CostProfile profile;
  const auto wedge = [](double height) { return height; };
  for (const LayerRange slab : {LayerRange{0, 1}, LayerRange{400, 408}, LayerRange{3999, 4000}})
    profile.add(slab, cost(slab, wedge));
  for (const LayerRange range : {all, LayerRange{17, 3950}, LayerRange{500, 501}})
    EXPECT_NEAR(profile.of(range).seconds, cost(range, wedge).seconds, 0.05) << range.begin;
  EXPECT_EQ(profile.of({5, 5}).seconds, 0);
}

TEST(CostProfile, KeepsTheLatestOfASlab) {
  CostProfile profile;
  EXPECT_TRUE(profile.is_empty());
  profile.add({100, 104}, {400, 8});
  profile.add({100, 104}, {4, 8});
  EXPECT_DOUBLE_EQ(profile.of(all).seconds, 4000);
  EXPECT_DOUBLE_EQ(profile.of(all).bytes, 8000);
}

TEST(CostProfile, FewSamplesTellTheWhole) {
  for (const auto of : {plate, cone, ball}) {
    const double whole = cost(all, of).bytes;
    CostProfile profile;
    size_t count = 0;
    for (const LayerRange& slab : spread(slabs(), 15)) {
      profile.add(slab, cost(slab, of));
      const double error = std::abs(profile.of(all).bytes / whole - 1);
      if (++count >= 3) {
        EXPECT_LT(error, count < 8 ? 0.3 : 0.1) << count << " samples";
      }
    }
    EXPECT_EQ(count, 15U);
  }
}

TEST(CostProfile, SpreadChoosesEachSlabOnce) {
  std::set<int64_t> begins;
  for (const LayerRange& slab : spread(slabs(), 5000)) begins.insert(slab.begin);
  EXPECT_EQ(begins.size(), 1000U);
  EXPECT_EQ(spread({{3, 5}}, 9), (std::vector<LayerRange>{{3, 5}}));
  EXPECT_TRUE(spread({}, 9).empty());
}

TEST(Forecast, SamplesAheadAndFollowsTheShape) {
  for (const auto of : {plate, cone, ball}) {
    Forecast forecast(slabs(), 1, 0);
    double left = cost(all, of).bytes;
    EXPECT_FALSE(forecast.left());
    size_t samples = 0;
    for (const LayerRange& slab : slabs()) {
      if (const auto sample = forecast.sample_ahead()) {
        ++samples;
        EXPECT_GT(sample->begin, slab.begin);
        forecast.add_sample(*sample, cost(*sample, of));
      }
      left -= cost(slab, of).bytes;
      forecast.add_written(cost(slab, of), 0);
      const auto estimate = forecast.left();
      if (samples < 5 || slab.begin > 3000) continue;
      ASSERT_TRUE(estimate);
      EXPECT_NEAR(estimate->bytes / left, 1, 0.3) << slab.begin;
      EXPECT_DOUBLE_EQ(estimate->seconds, estimate->bytes);
    }
    EXPECT_EQ(samples, 15U);
    EXPECT_EQ(forecast.left()->seconds, 0);
  }
}

TEST(Forecast, WritingTakesOneThread) {
  EXPECT_DOUBLE_EQ(wall_seconds(10, 2, 1), 12);
  EXPECT_DOUBLE_EQ(wall_seconds(1, 20, 1), 21);
  EXPECT_GE(wall_seconds(1, 20, 64), 20);
}

}  // namespace ombre::compile

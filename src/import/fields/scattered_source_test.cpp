#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "import/fields/result_source.h"

namespace ombre::importing {
namespace {

std::shared_ptr<const formats::Results> scattered_points(size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(-5, 5);
  auto results = std::make_shared<formats::Results>();
  formats::ResultField field{"f", "", 1, false, {}};
  for (size_t n = 0; n < count; ++n) {
    const double x = along(random), y = along(random), z = along(random);
    results->points.push_back({x, y, z});
    field.values.push_back(along(random));
  }
  results->fields.push_back(std::move(field));
  return results;
}

// Computes the expected value from all points.
double by_weights(const formats::Results& results, Vec3 p, size_t count) {
  std::vector<std::pair<double, double>> list;
  for (size_t n = 0; n < results.points.size(); ++n)
    list.emplace_back(length(p - results.points[n]), results.fields[0].values[n]);
  std::ranges::sort(list);
  double sum = 0, weights = 0;
  for (size_t n = 0; n < std::min(count, list.size()); ++n) {
    sum += list[n].second / (list[n].first * list[n].first);
    weights += 1 / (list[n].first * list[n].first);
  }
  return sum / weights;
}

}  // namespace

TEST(ScatteredSource, IsWhatLookingAtAllPointsGives) {
  for (const size_t count : {size_t{1}, size_t{5}, size_t{300}}) {
    const auto results = scattered_points(count);
    const auto weights = make_scattered_source("points", results, false, {}, {}),
               nearest = make_scattered_source("points", results, true, {}, {});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> along(-7, 7);
    for (int n = 0; n < 200; ++n) {
      const double x = along(random), y = along(random), z = along(random);
      ASSERT_NEAR(weights->sample(1, {x, y, z}), by_weights(*results, {x, y, z}, 8), 1e-9);
      ASSERT_NEAR(nearest->sample(1, {x, y, z}), by_weights(*results, {x, y, z}, 1), 1e-9);
      ASSERT_TRUE(weights->range(1, Box::everything()).contains(weights->sample(1, {x, y, z})));
    }
    for (size_t n = 0; n < count; ++n) ASSERT_EQ(weights->sample(1, results->points[n]), results->fields[0].values[n]);
  }
}

TEST(ScatteredSource, EndsWhereTheRuleSays) {
  auto results = std::make_shared<formats::Results>();
  results->points = {{0, 0, 0}};
  results->fields = {{"f", "", 1, false, {3}}};
  const auto none = make_scattered_source("points", results, false, {OutsideRule::Kind::none, 2, 0}, {}),
             value = make_scattered_source("points", results, false, {OutsideRule::Kind::value, 2, 7}, {});
  EXPECT_EQ(none->sample(1, {0, 0, 2}), 3);
  EXPECT_TRUE(std::isnan(none->sample(1, {0, 0, 2.1})));
  EXPECT_EQ(value->sample(1, {0, 0, 2.1}), 7);
  EXPECT_EQ(value->sample(0, {0, 0, 2.1}), 0);
}

}  // namespace ombre::importing

#include "surface/cells/point_evaluator.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "surface/cells/point_labels.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

using program::Builder;
using program::Field;

// Returns regions 1 to 3 by bands of x at 1 and 2, in a slab of |y| < 5.
Partition bands_of_x() {
  Builder builder;
  const Field x = builder.input(0), distance = abs(builder.input(1)) - 5;
  const Field band = select(x < 1, builder.constant(1), select(x < 2, builder.constant(2), builder.constant(3)));
  const Field label = select(distance < 0, band, builder.constant(0));
  Partition partition;
  partition.label = builder.finish({{"region", label}});
  partition.details = LocalPrograms(builder.finish({{"region", label}, {"distance", distance}, {"score", x}}),
                                    Box::centered({10, 10, 10}));
  partition.borders = {1, 2};
  partition.regions = 3;
  return partition;
}

// Returns two regions, of which the one with the greater of the scores x and 2 y wins.
Partition greater_of_two() {
  Builder builder;
  const Field x = builder.input(0), y = builder.input(1) * 2, distance = builder.constant(-1);
  const Field label = select(less(x, y), builder.constant(2), builder.constant(1));
  Partition partition;
  partition.label = builder.finish({{"region", label}});
  partition.details = LocalPrograms(builder.finish({{"region", label}, {"distance", distance}, {"one", x}, {"two", y}}),
                                    Box::centered({10, 10, 10}));
  partition.division = Division::greatest;
  partition.regions = 2;
  return partition;
}

}  // namespace

TEST(PointEvaluator, ValuesBetweenRegionsRiseFromTheOneToTheOther) {
  const Partition bands = bands_of_x();
  PointEvaluator evaluator;
  evaluator.begin(bands, bands.details.whole());
  evaluator.ask({{1.25, 0, 0}, {0, 7, 0}});
  EXPECT_EQ(evaluator.between(1, 2, 0), 0.25);
  EXPECT_EQ(evaluator.between(2, 1, 0), -0.25);
  EXPECT_EQ(evaluator.between(2, 3, 0), -0.75);
  EXPECT_EQ(evaluator.between(3, 2, 0), 0.75);
  EXPECT_EQ(evaluator.between(2, 0, 0), -5);
  EXPECT_EQ(evaluator.between(0, 2, 0), 5);
  EXPECT_EQ(evaluator.between(3, 0, 1), 2);
  const Partition greater = greater_of_two();
  evaluator.begin(greater, greater.details.whole());
  evaluator.ask({{3, 1, 0}});
  EXPECT_EQ(evaluator.between(1, 2, 0), -1);
  EXPECT_EQ(evaluator.between(2, 1, 0), 1);
}

// Rows of points are evaluated 128 at a time.
TEST(PointEvaluator, TakesAnyNumberOfPoints) {
  const Partition bands = bands_of_x();
  for (const size_t count : {0U, 1U, 127U, 128U, 129U, 1000U}) {
    std::vector<Vec3> points;
    for (size_t n = 0; n < count; ++n) points.push_back({0.003 * static_cast<double>(n), n % 10 == 0 ? 6.0 : 1.0, 0});
    PointEvaluator evaluator;
    evaluator.begin(bands, bands.details.whole());
    evaluator.ask(points);
    const std::vector<Label> labels = labels_at(bands, points, 2);
    ASSERT_EQ(labels.size(), count);
    for (size_t n = 0; n < count; ++n) {
      const Label wanted = n % 10 == 0 ? 0 : points[n].x < 1 ? 1 : points[n].x < 2 ? 2 : 3;
      EXPECT_EQ(evaluator.label(n), wanted);
      EXPECT_EQ(labels[n], wanted);
    }
  }
}

TEST(PointLabels, StopOnRequest) {
  StopFlag stop;
  stop.request();
  EXPECT_THROW(labels_at(bands_of_x(), {{1, 2, 3}}, 1, &stop), Cancelled);
}

}  // namespace ombre::surface

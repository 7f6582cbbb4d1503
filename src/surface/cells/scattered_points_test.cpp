#include "surface/cells/scattered_points.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "base/text/error.h"
#include "program/test_evaluation.h"
#include "surface/cells/shortened.h"
#include "surface/test_partitions.h"

namespace ombre::surface {
namespace {

// The distance to the nearest of many balls; near one of them, the others do not matter.
program::Program many_balls() {
  program::Builder b;
  std::vector<program::Field> balls;
  for (int n = 0; n < 64; ++n)
    balls.push_back(length(b.input(0) - 4.0 * (n % 8), b.input(1) - 4.0 * (n / 8), b.input(2)) - 1);
  return b.finish({{"distance", fold(balls, program::min)}});
}

std::vector<Vec3> points_on_a_plate(size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0, 32);
  std::vector<Vec3> points;
  for (size_t n = 0; n < count; ++n) points.push_back({any(random), any(random), 0.01 * any(random)});
  return points;
}

}  // namespace

TEST(ScatteredPoints, AreEachHandledOnceByAProgramThatHoldsAroundThem) {
  const program::Program whole = many_balls();
  const std::vector<Vec3> points = points_on_a_plate(20000);
  constexpr double margin = 0.5;
  for (const int threads : {1, 3}) {
    std::vector<std::atomic<int>> times(points.size());
    std::atomic<size_t> shortest = whole.code.size();
    work_at([&](const Box&) -> const program::Program& { return whole; }, points, margin, threads, nullptr,
            [&](const program::Program& program, std::span<const uint32_t> numbers) {
              for (const uint32_t n : numbers) ++times[n];
              const Vec3 first = points[numbers[0]];
              for (const Vec3 beside : {Vec3{0, 0, 0}, Vec3{margin, 0, 0}, Vec3{0, -margin, margin}})
                EXPECT_EQ(program::value_at(program, first + beside), program::value_at(whole, first + beside));
              if (program.code.size() < shortest) shortest = program.code.size();
            });
    for (const auto& count : times) ASSERT_EQ(count, 1);
    EXPECT_LT(shortest, whole.code.size() / 4);
  }
}

TEST(ScatteredPoints, MayBeNoneOrAllInOnePlace) {
  const program::Program whole = many_balls();
  const auto everywhere = [&](const Box&) -> const program::Program& { return whole; };
  work_at(everywhere, {}, 0, 1, nullptr, [](const program::Program&, std::span<const uint32_t>) { ADD_FAILURE(); });
  std::atomic<size_t> handled = 0;
  work_at(everywhere, std::vector<Vec3>(20000, Vec3{1, 2, 3}), 0, 1, nullptr,
          [&](const program::Program&, std::span<const uint32_t> numbers) { handled += numbers.size(); });
  EXPECT_EQ(handled, 20000U);
}

TEST(ScatteredPoints, AreLeftWhenWorkIsStopped) {
  const program::Program whole = many_balls();
  StopFlag stop;
  stop.request();
  EXPECT_THROW(work_at([&](const Box&) -> const program::Program& { return whole; }, points_on_a_plate(10), 0, 1, &stop,
                       [](const program::Program&, std::span<const uint32_t>) {}),
               Cancelled);
}

TEST(Shortened, ProgramsHoldInTheirBox) {
  const program::Program whole = many_balls();
  const Box box{{7, 7, -2}, {9, 9, 2}};
  const program::Program near = shortened_for(whole, box);
  EXPECT_LT(near.code.size(), whole.code.size() / 4);
  for (const Vec3 p : {box.lo, box.hi, box.center(), Vec3{7, 9, 0}})
    EXPECT_EQ(value_at(near, p), program::value_at(whole, p));
}

}  // namespace ombre::surface

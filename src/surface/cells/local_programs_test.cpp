#include "surface/cells/local_programs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/system/tasks.h"
#include "program/field.h"
#include "program/test_evaluation.h"

namespace ombre::surface {
namespace {

using program::Builder;
using program::Field;
using program::Program;

const Box space{{-12, -9, -10}, {12, 9, 10}};

Vec3 random_place(std::mt19937& random, const Box& box) {
  Vec3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = std::uniform_real_distribution(box.lo[axis], box.hi[axis])(random);
  return place;
}

// Returns a program for the distance to the nearest of many balls.
Program balls() {
  std::mt19937 random(2);
  Builder builder;
  Field nearest = builder.constant(1e9);
  for (int n = 0; n < 600; ++n) {
    const Vec3 at = random_place(random, space);
    const Field x = builder.input(0) - at.x, y = builder.input(1) - at.y, z = builder.input(2) - at.z;
    nearest = min(nearest, sqrt(square(x) + square(y) + square(z)) - 0.5);
  }
  return builder.finish({{"distance", nearest}});
}

}  // namespace

TEST(LocalPrograms, AreTheWholeOneWhereTheyHold) {
  const LocalPrograms programs(balls(), space);
  constexpr size_t boxes = 200;
  std::vector<size_t> lengths(boxes);
  run_parallel(boxes, 2, [&](size_t n) {
    std::mt19937 random(static_cast<unsigned>(n));
    const double half = std::pow(2.0, -static_cast<double>(n % 6));
    const Vec3 middle = random_place(random, space);
    const Box box = Box{middle, middle}.expanded(half);
    const Program& local = programs.around(box);
    EXPECT_EQ(&local, &programs.around(box));
    lengths[n] = local.code.size();
    for (int k = 0; k < 20; ++k) {
      const Vec3 place = random_place(random, box);
      EXPECT_EQ(value_at(local, place), value_at(programs.whole(), place));
    }
  });
  EXPECT_LT(lengths[5], programs.whole().code.size() / 4);
}

TEST(LocalPrograms, AroundAllOfSpaceAreWhole) {
  const LocalPrograms programs(balls(), space);
  EXPECT_EQ(&programs.around(space), &programs.whole());
  EXPECT_EQ(&programs.around(Box::centered({1e6, 1e6, 1e6})), &programs.whole());
}

TEST(LocalPrograms, OfNothingAreNothing) {
  const LocalPrograms programs;
  EXPECT_EQ(programs.around(space).code.size(), 0);
}

}  // namespace ombre::surface

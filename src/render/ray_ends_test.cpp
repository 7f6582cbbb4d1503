#include "render/ray_ends.h"

#include <gtest/gtest.h>

#include "program/evaluate.h"
#include "program/field.h"

namespace ombre::render {
namespace {

using program::Builder;
using program::Field;
using program::Program;

// Returns the program of a ball; a colour follows its shape.
Program ball(double radius, double red) {
  Builder builder;
  const Field far = length(builder.input(0), builder.input(1), builder.input(2));
  return builder.finish({{"inside", far < radius}, {"red", sin(far * red)}});
}

Program shape_of(Program program) {
  program.outputs.resize(1);
  return shape_alone(program);
}

const std::vector<double> where{0.5, 1, 2};

}  // namespace

TEST(RayEnds, ShapesAloneHaveNoColours) {
  const Program whole = ball(2, 3), shape = shape_of(whole);
  EXPECT_LT(shape.code.size(), whole.code.size());
  std::vector<double> values;
  for (const double x : {0.0, 1.9, 2.1}) {
    program::evaluate_point(shape, {x, 0, 0}, values);
    EXPECT_EQ(values[shape.outputs[0]], x < 2 ? 1 : 0);
  }
}

TEST(RayEnds, KeysAreThoseOfTheShape) {
  const auto key = key_of_ends(shape_of(ball(2, 3)), where);
  ASSERT_TRUE(key);
  EXPECT_EQ(key, key_of_ends(shape_of(ball(2, 3)), where));
  EXPECT_EQ(key, key_of_ends(shape_of(ball(2, 4)), where));
  EXPECT_NE(key, key_of_ends(shape_of(ball(2.0000001, 3)), where));
  EXPECT_NE(key, key_of_ends(ball(2, 3), where));
}

TEST(RayEnds, KeysAreThoseOfThePlaceToo) {
  const Program shape = shape_of(ball(2, 3));
  for (const std::vector<double>& other : {std::vector<double>{0.5, 1}, {0.5, 1, 3}, {1, 0.5, 2}, {}})
    EXPECT_NE(key_of_ends(shape, where), key_of_ends(shape, other));
}

TEST(RayEnds, ProgramsWithCallsHaveNoKey) {
  const auto body = std::make_shared<Program>(ball(2, 3));
  Builder builder;
  const Field inside = builder.call(body, 0, builder.input(0), builder.input(1), builder.input(2));
  EXPECT_FALSE(key_of_ends(builder.finish({{"inside", inside}}), where));
}

}  // namespace ombre::render

// Compares noise, mixtures and cells with their mathematical properties.
#include <gtest/gtest.h>

#include <cmath>

#include "nodes/test_values.h"
#include "program/test_evaluation.h"

namespace ombre::nodes {
namespace {

using namespace design;

class ValueNodes : public test::ValueTest {
 protected:
  program::Program numbers(const NodePtr& node, size_t output) {
    LoweringContext context(materials_, {node});
    program::Builder builder;
    Lowering lowering(context, builder);
    const Point p = Point::origin_frame(builder);
    std::vector<std::pair<std::string, Field>> outputs;
    for (const Field field : fields_of(lowering.answer(*node, output, p))) outputs.emplace_back("v", field);
    return builder.finish(outputs);
  }

  // Returns fractions by names of materials.
  std::map<std::string, double> fractions(const NodePtr& mix, Vec3 at) {
    LoweringContext context(materials_, {mix});
    program::Builder builder;
    Lowering lowering(context, builder);
    const Composition mixture = *lowering.answer(*mix, mix->first_output(), Point::origin_frame(builder)).composition;
    std::vector<std::pair<std::string, Field>> outputs;
    for (const auto& [id, fraction] : mixture.fractions) outputs.emplace_back(materials_.all()[id].name, fraction);
    context.finish_bodies();
    const program::Program program = program::inline_bodies(builder.finish(outputs));
    std::map<std::string, double> result;
    for (size_t n = 0; n < outputs.size(); ++n) result[outputs[n].first] = value_at(program, at, n);
    return result;
  }
};

}  // namespace

// At a lattice corner, all linear functions except its own have weight 0, and its own is 0.
TEST_F(ValueNodes, NoiseIsOneHalfInTheCorners) {
  const auto noise = numbers(make("noise", {{"size", Data(2.0)}}), 0);
  for (int n = -300; n < 300; n += 7) EXPECT_EQ(value_at(noise, {2.0 * n, 4, -6}), 0.5);
}

TEST_F(ValueNodes, TheMeanOfNoiseIsOneHalf) {
  const auto noise = numbers(make("noise", {{"size", Data(1.0)}, {"seed", Data(5.0)}}), 0);
  constexpr int count = 40000;
  double sum = 0, squares = 0, least = 1, greatest = 0;
  for (int n = 0; n < count; ++n) {
    const double v = value_at(noise, random_point(144));
    sum += v;
    squares += v * v;
    least = std::min(least, v);
    greatest = std::max(greatest, v);
  }
  const double mean = sum / count, deviation = std::sqrt(squares / count - mean * mean);
  EXPECT_NEAR(mean, 0.5, 4 * deviation / std::sqrt(count));
  EXPECT_LT(least, 0.2);
  EXPECT_GT(greatest, 0.8);
}

TEST_F(ValueNodes, TheSlopeOfNoiseMatchesDifferences) {
  const NodePtr node = make("noise", {{"size", Data(3.0)}, {"seed", Data(2.0)}});
  const auto noise = numbers(node, 0), slope = numbers(node, 1);
  constexpr double h = 1e-5;
  for (int n = 0; n < 300; ++n) {
    const Vec3 p = random_point(40);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 step;
      step[axis] = h;
      const double difference = (value_at(noise, p + step) - value_at(noise, p - step)) / (2 * h);
      EXPECT_NEAR(value_at(slope, p, static_cast<size_t>(axis)), difference, 1e-7);
    }
  }
}

// Noise and its slope are continuous across cell borders, also where the lattice repeats. It is periodic with 289
// cells.
TEST_F(ValueNodes, NoiseHasNoSeams) {
  const NodePtr node = make("noise", {{"size", Data(1.0)}});
  const auto noise = numbers(node, 0), slope = numbers(node, 1);
  constexpr double near = 1e-9;
  for (const double border : {-290.0, -289.0, -1.0, 0.0, 1.0, 17.0, 288.0, 289.0, 578.0}) {
    for (int n = 0; n < 20; ++n) {
      Vec3 below = random_point(5), above = below;
      below.x = border - near;
      above.x = border + near;
      EXPECT_NEAR(value_at(noise, below), value_at(noise, above), 1e-8);
      for (size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(value_at(slope, below, axis), value_at(slope, above, axis), 1e-7);
      EXPECT_NEAR(value_at(noise, above), value_at(noise, above + Vec3{289, -578, 289}), 1e-12);
    }
  }
}

TEST_F(ValueNodes, SeedsGiveDifferentNoise) {
  const auto a = numbers(make("noise", {{"seed", Data(1.0)}}), 0), b = numbers(make("noise", {{"seed", Data(2.0)}}), 0);
  int equal = 0;
  for (int n = 0; n < 100; ++n) {
    const Vec3 p = random_point(50);
    equal += std::abs(value_at(a, p) - value_at(b, p)) < 1e-6;
  }
  EXPECT_LT(equal, 3);
}

// Single precision computes the permutation exactly.
TEST_F(ValueNodes, ThePermutationIsExactInSinglePrecision) {
  for (int v = -288; v <= 577; ++v) {
    const float s = static_cast<float>(v), product = (s * 34 + 1) * s;
    const float remainder = product - std::floor(product / 289) * 289;
    EXPECT_EQ(static_cast<int>(remainder), (34 * v + 1) * v % 289) << v;
  }
}

TEST_F(ValueNodes, MixOfNumbersIsBetweenThem) {
  const auto mix = numbers(make("mix", {{"a", Data(2.0)}, {"b", Data("10 + y")}, {"t", Data("x")}}), 0);
  EXPECT_EQ(value_at(mix, {0.25, 0, 0}), 4);
  EXPECT_EQ(value_at(mix, {0.5, 4, 0}), 8);
  EXPECT_EQ(value_at(mix, {-1, 0, 0}), 2);
  EXPECT_EQ(value_at(mix, {7, 1, 0}), 11);
}

TEST_F(ValueNodes, MixOfMaterialsHasTheirShares) {
  const NodePtr mix = make("mix", {{"a", Data("red")}, {"b", Data("blue")}, {"t", Data("x")}});
  using Fractions = std::map<std::string, double>;
  EXPECT_EQ(fractions(mix, {0.25, 0, 0}), (Fractions{{"red", 0.75}, {"blue", 0.25}}));
  EXPECT_EQ(fractions(mix, {-3, 0, 0}), (Fractions{{"red", 1}, {"blue", 0}}));
  EXPECT_EQ(fractions(mix, {3, 0, 0}), (Fractions{{"red", 0}, {"blue", 1}}));
  // This mixture is half red and half the one above.
  const NodePtr more = make("mix", {{"a", Data("red")}, {"b", object(mix)}});
  EXPECT_EQ(fractions(more, {0.25, 0, 0}), (Fractions{{"red", 0.875}, {"blue", 0.125}}));
  const NodePtr third = make("mix", {{"a", object(mix)}, {"b", Data("clear")}, {"t", Data(0.5)}});
  EXPECT_EQ(fractions(third, {0.25, 0, 0}), (Fractions{{"red", 0.375}, {"blue", 0.125}, {"clear", 0.5}}));
}

TEST_F(ValueNodes, CellsAreThoseOfFloor) {
  const NodePtr node = make("cells", {{"size", Data(DataList{Data(4.0), Data(5.0), Data(0.0)})}});
  const auto index = numbers(node, 0), local = numbers(node, 1), distance = numbers(node, 2);
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random_point(30);
    const double i = std::floor(p.x / 4 + 0.5), j = std::floor(p.y / 5 + 0.5);
    EXPECT_EQ(value_at(index, p, 0), i);
    EXPECT_EQ(value_at(index, p, 1), j);
    EXPECT_EQ(value_at(index, p, 2), 0);
    EXPECT_NEAR(value_at(local, p, 0), p.x / 4 - i, 1e-12);
    EXPECT_NEAR(value_at(local, p, 1), p.y / 5 - j, 1e-12);
    // The borders are at 2 + 4 i and 2.5 + 5 j.
    const double to_x = std::abs(std::remainder(p.x - 2, 4)), to_y = std::abs(std::remainder(p.y - 2.5, 5));
    EXPECT_NEAR(value_at(distance, p), std::min(to_x, to_y), 1e-9);
  }
}

}  // namespace ombre::nodes

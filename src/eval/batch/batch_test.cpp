// Tests of float batches: bits are equal for every instruction set and shape of box, and values lie in their intervals.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "base/math/math.h"
#include "eval/batch/batch.h"
#include "program/evaluate.h"
#include "program/field.h"
#include "program/passes/passes.h"
#include "program/program_text.h"
#include "program/single.h"

namespace ombre::eval {
namespace {

using program::Op;
using program::Program;

constexpr float inf = std::numeric_limits<float>::infinity();

bool same_bits(float a, float b) { return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0; }

class NoRows : public SourceRows {
 public:
  bool has(const program::Read&) const override { return false; }
  void fill(const program::Read&, const RowsToFill&) const override {}
};

struct Points {
  std::vector<float> xs, ys, zs;
  BoxPoints points() const { return {xs, ys, zs}; }
  Box box() const {
    const auto ends = [](const std::vector<float>& v) { return std::minmax_element(v.begin(), v.end()); };
    const auto [x, y, z] = std::tuple(ends(xs), ends(ys), ends(zs));
    return {{*x.first, *y.first, *z.first}, {*x.second, *y.second, *z.second}};
  }
};

// Returns all outputs at all points, indexed [output][k][j][i].
std::vector<float> evaluate(const KernelSet& kernels, const Program& program, const Points& points) {
  std::vector<Interval> ranges;
  program::evaluate_intervals(program, points.box(), ranges, nullptr, program::Precision::batch);
  BatchEvaluator evaluator(kernels);
  const NoRows no_rows;
  evaluator.begin(program, ranges, points.points(), no_rows);
  const size_t plane = points.xs.size() * points.ys.size(), all = plane * points.zs.size();
  std::vector<float> values(program.outputs.size() * all);
  for (size_t k = 0; k < points.zs.size(); ++k) {
    evaluator.begin_layer(k);
    for (size_t j = 0; j < points.ys.size(); ++j) {
      evaluator.begin_row(j);
      evaluator.finish_row();
      for (size_t n = 0; n < program.outputs.size(); ++n)
        for (size_t i = 0; i < points.xs.size(); ++i)
          values[n * all + k * plane + j * points.xs.size() + i] = evaluator.output(n)[i];
    }
  }
  return values;
}

// Returns a program with several outputs that depend on all axes, made of random ops.
Program random_program(std::mt19937& random, size_t size) {
  program::Builder builder;
  std::vector<program::Field> fields{builder.input(0), builder.input(1), builder.input(2)};
  for (const double v : {0.5, -2.0, 3.0}) fields.push_back(builder.constant(v));
  const auto any = [&] { return fields[random() % fields.size()]; };
  for (size_t n = 0; n < size; ++n)
    fields.push_back(
        builder.apply(program::numeric_ops[random() % std::size(program::numeric_ops)], any(), any(), any()));
  std::vector<std::pair<std::string, program::Field>> outputs;
  for (size_t n = 0; n < 4; ++n) outputs.emplace_back("v", fields[fields.size() - 1 - n]);
  return builder.finish(outputs);
}

Points random_points(std::mt19937& random, size_t width, size_t rows, size_t layers) {
  const auto some = [&](size_t count, float around) {
    std::vector<float> values;
    for (size_t n = 0; n < count; ++n) values.push_back(around + std::uniform_real_distribution<float>(-1, 1)(random));
    return values;
  };
  const auto place = [&] { return std::uniform_real_distribution<float>(-6, 6)(random); };
  return {some(width, place()), some(rows, place()), some(layers, place())};
}

}  // namespace

TEST(Batch, EveryInstructionSetGivesTheSameBits) {
  const auto& sets = kernel_sets();
  if (sets.empty()) GTEST_SKIP() << "no hardware multiply-add";
  std::mt19937 random(1);
  const float odd[] = {0.0f,   -0.0f, 1,    -1,    inf,        -inf,  std::nanf(""), 1e30f,   -1e30f,
                       1e-40f, 0.5f,  2.5f, -2.5f, 3.1415927f, 29999, 1e9f,          16777216};
  const auto pick = [&] {
    if (random() % 3 == 0) return odd[random() % std::size(odd)];
    return std::uniform_real_distribution<float>(-8, 8)(random);
  };
  constexpr size_t count = 4096;
  alignas(64) static float a[count], b[count], c[count], first[count], other[count];
  for (size_t n = 0; n < count; ++n) a[n] = pick(), b[n] = pick(), c[n] = pick();
  for (const Op op : program::numeric_ops) {
    const int arity = program::info(op).arity;
    for (unsigned shape = 0; shape < (arity == 1 ? 1u : arity == 2 ? 3u : 7u); ++shape) {
      for (const Unknowns unknowns : {Unknowns::never, Unknowns::possible}) {
        sets[0].kernel(op, shape, unknowns)(a, b, c, first, count);
        for (size_t s = 1; s < sets.size(); ++s) {
          sets[s].kernel(op, shape, unknowns)(a, b, c, other, count);
          for (size_t n = 0; n < count; ++n) {
            const bool has_nan = std::isnan(a[n]) || std::isnan(b[n]) || std::isnan(c[n]);
            if (unknowns == Unknowns::never && has_nan) continue;
            ASSERT_TRUE(same_bits(first[n], other[n]))
                << program::info(op).name << "(" << a[n] << ", " << b[n] << ", " << c[n] << ") is " << first[n]
                << " with " << sets[0].name << ", " << other[n] << " with " << sets[s].name << ", shape " << shape;
          }
        }
      }
    }
  }
}

// If the reference has a value that a float can hold, the batch is accurate to one unit in the last place.
TEST(Batch, ElementaryFunctionsAreAccurate) {
  const auto& sets = kernel_sets();
  if (sets.empty()) GTEST_SKIP();
  std::mt19937 random(2);
  constexpr size_t count = 16384;
  alignas(64) static float a[count], b[count], c[count], out[count];
  for (const Op op : program::numeric_ops) {
    const bool truth = op >= Op::less && op <= Op::is_finite;
    const bool jumps = op == Op::mod || truth;  // results are exact or discontinuous
    for (size_t n = 0; n < count; ++n) {
      a[n] = std::uniform_real_distribution<float>(-20, 20)(random);
      b[n] = std::uniform_real_distribution<float>(-5, 5)(random);
      c[n] = std::uniform_real_distribution<float>(-5, 5)(random);
    }
    sets[0].kernel(op, 0, Unknowns::never)(a, b, c, out, count);
    for (size_t n = 0; n < count; ++n) {
      const double exact = program::apply<double>(op, a[n], b[n], c[n]);
      if (std::isnan(exact)) continue;
      const float rounded = static_cast<float>(exact);
      const double unit = static_cast<double>(std::nextafter(std::abs(rounded), inf)) - std::abs(rounded);
      double allowed = jumps ? 0 : unit;
      if (op == Op::sin || op == Op::cos) allowed = program::batch_trigonometric_error;
      if (std::isinf(rounded)) continue;
      ASSERT_NEAR(out[n], exact, allowed)
          << program::info(op).name << "(" << a[n] << ", " << b[n] << ", " << c[n] << ")";
    }
  }
}

TEST(Batch, SineAndCosineHoldUpToTheirLimit) {
  const auto& sets = kernel_sets();
  if (sets.empty()) GTEST_SKIP();
  constexpr size_t count = 1 << 16;
  alignas(64) static float a[count], sines[count], cosines[count], alone[count];
  const float limit = static_cast<float>(program::batch_trigonometric_limit);
  for (size_t n = 0; n < count; ++n) a[n] = -limit + static_cast<float>(n) * (2 * limit / (count - 1));
  sets[0].sine_cosine(a, sines, cosines, count);
  double worst = 0;
  for (size_t n = 0; n < count; ++n) {
    worst = std::max({worst, std::abs(sines[n] - math::sin(a[n])), std::abs(cosines[n] - math::cos(a[n]))});
    EXPECT_LE(std::abs(sines[n]), 1);
    EXPECT_LE(std::abs(cosines[n]), 1);
  }
  EXPECT_LE(worst, program::batch_trigonometric_error / 2);
  sets[0].kernel(Op::sin, 0, Unknowns::never)(a, a, a, alone, count);
  EXPECT_EQ(std::memcmp(alone, sines, sizeof sines), 0);
  sets[0].kernel(Op::cos, 0, Unknowns::never)(a, a, a, alone, count);
  EXPECT_EQ(std::memcmp(alone, cosines, sizeof cosines), 0);
}

TEST(Batch, BoxesOfAnyShapeGiveTheSameBits) {
  const auto& sets = kernel_sets();
  if (sets.empty()) GTEST_SKIP();
  std::mt19937 random(3);
  for (int n = 0; n < 300; ++n) {
    const Program program = random_program(random, 30);
    const Points points = random_points(random, 1 + random() % 40, 1 + random() % 5, 1 + random() % 3);
    const std::vector<float> whole = evaluate(sets[0], program, points);
    size_t at = 0;
    const size_t all = whole.size() / program.outputs.size();
    for (const float z : points.zs) {
      for (const float y : points.ys) {
        for (const float x : points.xs) {
          const std::vector<float> alone = evaluate(sets.back(), program, {{x}, {y}, {z}});
          for (size_t o = 0; o < alone.size(); ++o)
            ASSERT_TRUE(same_bits(alone[o], whole[o * all + at]))
                << to_text(program) << o << ": " << alone[o] << " " << whole[o * all + at] << " at " << x << " " << y
                << " " << z;
          ++at;
        }
      }
    }
  }
}

TEST(Batch, ListsOfPointsGiveTheSameBits) {
  const auto& sets = kernel_sets();
  if (sets.empty()) GTEST_SKIP();
  std::mt19937 random(5);
  for (int n = 0; n < 300; ++n) {
    const Program program = random_program(random, 30);
    const Points axes = random_points(random, 5, 4, 3);
    const std::vector<float> expected = evaluate(sets[0], program, axes);
    Points list;
    for (const float z : axes.zs)
      for (const float y : axes.ys)
        for (const float x : axes.xs) list.xs.push_back(x), list.ys.push_back(y), list.zs.push_back(z);
    std::vector<Interval> ranges;
    program::evaluate_intervals(program, axes.box(), ranges, nullptr, program::Precision::batch);
    BatchEvaluator evaluator(sets[0]);
    const NoRows no_rows;
    evaluator.compile_for_list(program, ranges, list.xs.size(), no_rows);
    evaluator.place(PointList{list.xs, list.ys, list.zs});
    evaluator.begin_layer(0);
    evaluator.begin_row(0);
    evaluator.finish_row();
    for (size_t o = 0; o < program.outputs.size(); ++o)
      for (size_t p = 0; p < list.xs.size(); ++p)
        ASSERT_TRUE(same_bits(evaluator.output(o)[p], expected[o * list.xs.size() + p])) << to_text(program) << o;
  }
}

TEST(Batch, IntervalsHoldEveryValueAndShorteningKeepsThem) {
  const auto& sets = kernel_sets();
  if (sets.empty()) GTEST_SKIP();
  std::mt19937 random(4);
  for (int n = 0; n < 20000; ++n) {
    const Program program = fuse(sign_only(random_program(random, 25)));
    const Points points = random_points(random, 8, 4, 2);
    std::vector<Interval> ranges;
    evaluate_intervals(program, points.box(), ranges, nullptr, program::Precision::batch);
    const std::vector<float> values = evaluate(sets[0], program, points);
    const size_t all = values.size() / program.outputs.size();
    for (size_t o = 0; o < program.outputs.size(); ++o)
      for (size_t p = 0; p < all; ++p)
        ASSERT_TRUE(ranges[program.outputs[o]].contains(values[o * all + p]))
            << to_text(program) << values[o * all + p] << " not in " << ranges[program.outputs[o]].lo << " "
            << ranges[program.outputs[o]].hi;
    const std::vector<float> shortened = evaluate(sets[0], shorten(program, ranges), points);
    for (size_t p = 0; p < values.size(); ++p)
      ASSERT_TRUE(same_bits(values[p], shortened[p]) || values[p] == shortened[p])
          << to_text(program) << "\nshortened " << to_text(shorten(program, ranges)) << values[p] << " "
          << shortened[p];
  }
}

}  // namespace ombre::eval

// Compares intervals over many boxes at once with those over single boxes, for every instruction set.
#include "eval/batch/box_intervals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "eval/batch/kernels.h"
#include "program/evaluate.h"
#include "program/field.h"
#include "program/passes/passes.h"
#include "program/program_text.h"
#include "program/single.h"

namespace ombre::eval {
namespace {

using program::Builder;
using program::Field;
using program::Op;
using program::Program;

constexpr double infinite = std::numeric_limits<double>::infinity();

// These ops use functions on floats instead of doubles.
constexpr Op wider_ops[] = {Op::sin, Op::cos, Op::atan2, Op::exp};
bool is_wider(Op op) { return std::find(std::begin(wider_ops), std::end(wider_ops), op) != std::end(wider_ops); }

// Returns a program in which every value is an output. Some constants exceed the range of floats.
Program random_program(std::mt19937& random, size_t size, bool with_wider) {
  Builder builder;
  std::vector<Field> fields{builder.input(0), builder.input(1), builder.input(2)};
  for (const double v : {0.0, 1.0, 0.5, -2.0, 3e38, 1e300, infinite, std::nan("")})
    fields.push_back(builder.constant(v));
  const auto any = [&] { return fields[random() % fields.size()]; };
  for (size_t n = 0; n < size; ++n) {
    const Op op = program::numeric_ops[random() % std::size(program::numeric_ops)];
    if (with_wider || !is_wider(op)) fields.push_back(builder.apply(op, any(), any(), any()));
  }
  std::vector<std::pair<std::string, Field>> outputs;
  for (const Field& field : fields) outputs.emplace_back("v", field);
  return fuse(builder.finish(outputs));
}

// Returns points, thin boxes and wide boxes, some of which contain 0.
std::vector<Box> random_boxes(std::mt19937& random, size_t count) {
  const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
  constexpr double sizes[] = {0, 1e-3, 0.5, 8};
  std::vector<Box> boxes;
  for (size_t n = 0; n < count; ++n) {
    const Vec3 lo{between(-6, 6), between(-6, 6), random() % 4 == 0 ? 0 : between(-6, 6)};
    const double size = sizes[random() % std::size(sizes)];
    boxes.push_back({lo, lo + Vec3{between(0, size), between(0, size), between(0, size)}});
  }
  return boxes;
}

void no_sources(const program::Read&, const BoxIntervals::Place&, IntervalRow) { FAIL() << "there are none"; }

std::string text(Interval v) { return "[" + std::to_string(v.lo) + ", " + std::to_string(v.hi) + "]"; }

}  // namespace

TEST(BoxIntervals, AreThoseOfOneBoxEach) {
  for (const KernelSet& kernels : kernel_sets()) {
    std::mt19937 random(11);
    BoxIntervals evaluator(kernels);
    for (int round = 0; round < 3000; ++round) {
      const Program program = random_program(random, 25, false);
      const std::vector<Box> boxes = random_boxes(random, 1 + random() % 40);
      evaluator.evaluate(program, boxes, no_sources);
      for (size_t box = 0; box < boxes.size(); ++box) {
        std::vector<Interval> alone, together;
        evaluate_intervals(program, boxes[box], alone, nullptr, program::Precision::batch);
        evaluator.values(box, together);
        for (size_t id = 0; id < alone.size(); ++id)
          ASSERT_EQ(together[id], alone[id])
              << kernels.name << "\n"
              << to_text(program) << "v" << id << " is " << text(together[id]) << ", alone " << text(alone[id]);
      }
    }
  }
}

// Tests few and many parts near the boxes. Positions are multiples of 1/8, so that nothing is rounded.
TEST(BoxIntervals, PartsReachTheBoxesThatTheirPiecesMeet) {
  std::mt19937 random(12);
  const auto eighths = [&](int lo, int hi) { return 0.125 * std::uniform_int_distribution(8 * lo, 8 * hi)(random); };
  const auto some_box = [&](int reach, Vec3 size) {
    const Vec3 low{eighths(-reach, reach), eighths(-reach, reach), eighths(-reach, reach)};
    return Box{low, low + size};
  };
  for (const int parts : {3, 40, 4000}) {
    auto set = std::make_shared<program::PartSet>();
    set->slots = {program::SlotKind::any};
    set->ranges = {Interval(0, 1)};
    for (int n = 0; n < parts; ++n) {
      program::Cells slice;
      slice.first[0] = static_cast<uint8_t>(random() % 128);
      slice.last[0] = static_cast<uint8_t>(slice.first[0] + random() % 128);
      set->index.add(some_box(30, {32, 4, 2}), {slice});
    }
    set->index.build();
    program::Builder builder;
    const program::Field inside = builder.parts(set, 0, builder.input(0), builder.input(1), builder.input(2));
    const Program program = builder.finish({{"inside", inside}});
    size_t reached = 0;
    for (const KernelSet& kernels : kernel_sets()) {
      BoxIntervals evaluator(kernels);
      for (int round = 0; round < 50; ++round) {
        std::vector<Box> boxes;
        for (size_t n = 1 + random() % 64; n > 0; --n)
          boxes.push_back(some_box(40, {eighths(0, 5), eighths(0, 5), eighths(0, 5)}));
        evaluator.evaluate(program, boxes, no_sources);
        for (size_t box = 0; box < boxes.size(); ++box) {
          const bool is_reached = set->index.reaches(boxes[box]);
          reached += is_reached;
          EXPECT_EQ(evaluator.output(0, box), is_reached ? Interval(0, 1) : Interval(0)) << parts;
        }
      }
    }
    EXPECT_GT(reached, 0u);
  }
}

// The intervals contain those of double precision, and are wider only by the rounding of floats.
TEST(BoxIntervals, WavesHoldTheirCrestsAndAreTight) {
  for (const KernelSet& kernels : kernel_sets()) {
    std::mt19937 random(12);
    BoxIntervals evaluator(kernels);
    Builder builder;
    const Field x = builder.input(0);
    const Program program =
        builder.finish({{"sine", builder.apply(Op::sin, x, x, x)}, {"cosine", builder.apply(Op::cos, x, x, x)}});
    for (int round = 0; round < 20000; ++round) {
      const double scale = std::pow(10, static_cast<double>(random() % 6) - 1);
      const double lo = static_cast<double>(std::uniform_real_distribution<float>(-1, 1)(random)) * scale;
      const double size = static_cast<double>(random() % 4) + 1e-3;
      const Box box{{lo, 0, 0}, {static_cast<double>(static_cast<float>(lo + size)), 0, 0}};
      evaluator.evaluate(program, {&box, 1}, no_sources);
      for (size_t output = 0; output < 2; ++output) {
        const Interval argument = program::to_single(box.axis(0));
        const Interval exact = output == 0 ? math::sin(argument) : math::cos(argument);
        const Interval found = evaluator.output(output, 0);
        ASSERT_LE(found.lo, exact.lo + 1e-12) << text(argument);
        ASSERT_GE(found.hi, exact.hi - 1e-12) << text(argument);
        // A wave's slope is at most 1, and it is flat at crests.
        const double slack = 1e-6 + 1e-11 * scale * scale;
        ASSERT_GE(found.lo, exact.lo - slack) << text(argument);
        ASSERT_LE(found.hi, exact.hi + slack) << text(argument);
      }
    }
  }
}

TEST(BoxIntervals, HoldWhatBatchesComputeAndAreTight) {
  const auto& sets = kernel_sets();
  for (size_t set = 0; set < sets.size(); ++set) {
    std::mt19937 random(15);
    BoxIntervals evaluator(sets[set]);
    for (const Op op : wider_ops) {
      Builder builder;
      const Program program =
          builder.finish({{"value", builder.apply(op, builder.input(0), builder.input(1), builder.input(2))}});
      for (int round = 0; round < 5000; ++round) {
        const Box box = random_boxes(random, 1)[0];
        evaluator.evaluate(program, {&box, 1}, no_sources);
        const Interval found = evaluator.output(0, 0);
        std::vector<Interval> alone;
        evaluate_intervals(program, box, alone, nullptr, program::Precision::batch);
        const Interval exact = alone[program.outputs[0]];
        const double slack = 2e-6 * std::max({1.0, std::abs(exact.lo), std::abs(exact.hi)});
        ASSERT_NEAR(found.lo, exact.lo, slack) << info(op).name;
        ASSERT_NEAR(found.hi, exact.hi, slack) << info(op).name;
        alignas(64) float x[batch_lanes], y[batch_lanes], out[batch_lanes];
        const auto within = [&](Interval v) {
          const double at = v.lo + (v.hi - v.lo) * std::uniform_real_distribution<double>(0, 1)(random);
          return std::clamp(static_cast<float>(at), static_cast<float>(v.lo), static_cast<float>(v.hi));
        };
        for (size_t n = 0; n < batch_lanes; ++n) {
          x[n] = within(box.axis(0));
          y[n] = within(box.axis(1));
        }
        kernel_sets()[set].kernel(op, all_rows, Unknowns::never)(x, y, y, out, batch_lanes);
        for (const float value : out)
          ASSERT_TRUE(found.contains(static_cast<double>(value)))
              << info(op).name << " is " << value << ", not in " << text(found);
      }
    }
  }
}

TEST(BoxIntervals, EveryInstructionSetGivesTheSame) {
  const auto& sets = kernel_sets();
  if (sets.size() < 2) GTEST_SKIP() << "one instruction set";
  std::mt19937 random(13);
  for (int round = 0; round < 2000; ++round) {
    const Program program = random_program(random, 30, true);
    const std::vector<Box> boxes = random_boxes(random, 16);
    BoxIntervals first(sets[0]);
    first.evaluate(program, boxes, no_sources);
    for (size_t s = 1; s < sets.size(); ++s) {
      BoxIntervals other(sets[s]);
      other.evaluate(program, boxes, no_sources);
      for (size_t box = 0; box < boxes.size(); ++box)
        for (size_t n = 0; n < program.outputs.size(); ++n)
          ASSERT_EQ(first.output(n, box), other.output(n, box)) << to_text(program) << n;
    }
  }
}

TEST(BoxIntervals, HullsHoldTheBoxesTheyAreOf) {
  const auto& sets = kernel_sets();
  if (sets.empty()) GTEST_SKIP() << "no hardware multiply-add";
  std::mt19937 random(14);
  const Program program = random_program(random, 20, true);
  const std::vector<Box> boxes = random_boxes(random, 20);
  BoxIntervals evaluator(sets[0]);
  evaluator.evaluate(program, boxes, no_sources);
  const std::vector<size_t> some{3, 4, 19};
  std::vector<Interval> all, one;
  evaluator.values(some, all);
  std::vector<Interval> expected(program.code.size(), Interval(infinite, -infinite));
  for (const size_t box : some) {
    evaluator.values(box, one);
    for (size_t id = 0; id < one.size(); ++id) expected[id] = hull(expected[id], one[id]);
  }
  EXPECT_EQ(all, expected);
}

}  // namespace ombre::eval

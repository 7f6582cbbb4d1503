// Tests the example of every operator of the library at points, over boxes, and in batches of each instruction set.
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/system/test_source_files.h"
#include "eval/batch/batch.h"
#include "jobs/test_designs.h"
#include "load/library_operators.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"
#include "program/passes/prepare.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

using program::Program;

std::vector<Operator> operators() { return operators_in({source_file("data/library")}); }

// Returns the example as a script, whose models are those of the repository.
std::string script_of(const Operator& one) {
  std::string example = one.declaration.example;
  if (const size_t models = example.find("models/"); models != std::string::npos)
    example.insert(models, source_file("examples/"));
  return "use <" + one.library + ">\n" + example + '\n';
}

// The numbers of a design as a program: inside, the fractions, the distance and the attributes.
struct Numbers {
  Program program;
  size_t fractions = 0;
};

std::optional<Numbers> numbers_of(const design::Design& design, Diagnostics& diagnostics) {
  Question question(design);
  program::Outputs outputs{{"inside", question.inside()}};
  for (const auto& [material, fraction] : question.composition().fractions) outputs.emplace_back("fraction", fraction);
  const size_t fractions = outputs.size() - 1;
  outputs.emplace_back("distance", question.distance());
  for (const std::string& name : all_attribute_parts(design))
    if (const auto number = question.attribute(name, diagnostics)) outputs.emplace_back(name, *number);
  auto whole = question.program(outputs, diagnostics);
  if (!whole) return std::nullopt;
  std::vector<Interval> ranges;
  evaluate_intervals(*whole, Box::centered({1e4, 1e4, 1e4}), ranges);
  return Numbers{program::expand_parts(*whole, ranges, program::Precision::reference), fractions};
}

std::vector<double> at(const Program& program, Vec3 p) {
  std::vector<double> values, outputs;
  evaluate_point(program, p, values);
  for (const auto id : program.outputs) outputs.push_back(values[id]);
  return outputs;
}

class EveryOperator : public testing::TestWithParam<Operator> {
 protected:
  void SetUp() override {
    Diagnostics diagnostics;
    loaded_ = load_text(script_of(GetParam()), diagnostics);
    if (to_text(diagnostics).find("ombre was built without") != std::string::npos) GTEST_SKIP();
    ASSERT_TRUE(loaded_) << to_text(diagnostics);
    auto numbers = numbers_of(loaded_->design, diagnostics);
    ASSERT_TRUE(numbers) << to_text(diagnostics);
    numbers_ = std::move(*numbers);
  }
  void expect_intervals_that_hold_points();
  void expect_shares_of_one();
  void expect_the_same_bits();
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  Vec3 place(Vec3 from, double size) { return from + Vec3{number(0, size), number(0, size), number(0, size)}; }

  LoadedPtr loaded_;
  Numbers numbers_;
  std::mt19937 random_{47};
};

// Places that share no bits with borders of examples.
constexpr Vec3 least{-9.97, -9.83, -9.71};
constexpr double extent = 19.6;

// Intervals hold what is found at points, and programs that they shorten give the same.
void EveryOperator::expect_intervals_that_hold_points() {
  const Program& program = numbers_.program;
  for (int n = 0; n < 12; ++n) {
    const Vec3 low = place(least, extent);
    const double size = n % 2 ? number(0, 0.5) : number(0, 5);
    std::vector<Interval> ranges;
    evaluate_intervals(program, {low, low + Vec3{size, size, size}}, ranges);
    const Program shorter = program::shorten(program, ranges);
    for (int i = 0; i < 6; ++i) {
      const Vec3 p = place(low, size);
      std::vector<double> values;
      evaluate_point(program, p, values);
      for (size_t v = 0; v < values.size(); ++v)
        ASSERT_TRUE(ranges[v].contains(values[v])) << "v" << v << " = " << values[v];
      const auto whole = at(program, p), part = at(shorter, p);
      for (size_t o = 0; o < whole.size(); ++o)
        ASSERT_TRUE(whole[o] == part[o] || (std::isnan(whole[o]) && std::isnan(part[o]))) << "output " << o;
    }
  }
}

void EveryOperator::expect_shares_of_one() {
  size_t inside = 0;
  for (int n = 0; n < 1000; ++n) {
    const auto values = at(numbers_.program, place(least, extent));
    if (values[0] == 0) continue;
    ++inside;
    double sum = 0;
    for (size_t f = 1; f <= numbers_.fractions; ++f) {
      ASSERT_GE(values[f], 0);
      sum += values[f];
    }
    ASSERT_NEAR(sum, 1, 1e-12);
  }
  EXPECT_GT(inside, 0);
}

class NoRows : public eval::SourceRows {
 public:
  bool has(const program::Read&) const override { return false; }
  void fill(const program::Read&, const eval::RowsToFill&) const override {}
};

// Returns the bits of all outputs at some points, as one instruction set computes them.
std::vector<uint32_t> bits_of(const Program& program, const eval::KernelSet& kernels, const eval::PointList& points,
                              size_t count) {
  const std::vector<Interval> ranges(program.code.size(), Interval::everything());
  const NoRows rows;
  eval::BatchEvaluator batch(kernels);
  batch.compile_for_list(program, ranges, count, rows);
  batch.place(points);
  batch.begin_layer(0);
  batch.begin_row(0);
  batch.finish_row();
  std::vector<uint32_t> bits;
  for (size_t output = 0; output < program.outputs.size(); ++output)
    for (size_t n = 0; n < count; ++n) bits.push_back(std::bit_cast<uint32_t>(batch.output(output)[n]));
  return bits;
}

// Every instruction set gives the same bits.
void EveryOperator::expect_the_same_bits() {
  if (eval::kernel_sets().empty()) return;
  const Program program = program::prepare(numbers_.program, program::Purpose::batch);
  constexpr size_t count = 256;
  std::vector<float> xs, ys, zs;
  for (size_t n = 0; n < count; ++n) {
    const Vec3 p = place(least, extent);
    xs.push_back(static_cast<float>(p.x));
    ys.push_back(static_cast<float>(p.y));
    zs.push_back(static_cast<float>(p.z));
  }
  const auto first = bits_of(program, eval::kernel_sets().front(), {xs, ys, zs}, count);
  for (const eval::KernelSet& kernels : eval::kernel_sets())
    EXPECT_EQ(bits_of(program, kernels, {xs, ys, zs}, count), first) << kernels.name;
}

}  // namespace

TEST_P(EveryOperator, KeepsTheRulesOfNodes) {
  expect_intervals_that_hold_points();
  expect_shares_of_one();
  expect_the_same_bits();
}

INSTANTIATE_TEST_SUITE_P(Operators, EveryOperator, testing::ValuesIn(operators()),
                         [](const auto& test) { return test.param.declaration.name; });

}  // namespace ombre::compile

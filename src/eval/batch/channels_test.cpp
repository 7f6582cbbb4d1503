// Channels of one source at the same points are sampled together.
#include <gtest/gtest.h>

#include "eval/batch/batch.h"
#include "eval/rows.h"
#include "program/field.h"

namespace ombre::eval {
namespace {

using program::Builder;

class AnySource : public program::FieldSource {
 public:
  std::string name() const override { return "any"; }
  Hash content() const override { return {1, 4}; }
  Box bounds() const override { return Box::centered({9, 9, 9}); }
  int channel(std::string_view) const override { return 0; }
};

// A source whose channel n is x + n * y. It records the number of channels of each call.
class FourChannels : public AnySource {
 public:
  double sample(int channel, Vec3 p) const override { return p.x + channel * p.y; }
  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override {
    group_sizes.push_back(channels.size());
    FieldSource::sample_channels(channels, points, values);
  }

  mutable std::vector<size_t> group_sizes;
};

// A source with value x that records the points at which it is sampled.
class QueriedPoints : public AnySource {
 public:
  double sample(int, Vec3 p) const override {
    queried.push_back(p.x);
    return p.x;
  }

  mutable std::vector<double> queried;
};

// Returns a program that reads all channels at (x, y, z), and one at (y, x, z).
program::Program program_of(const std::shared_ptr<FourChannels>& source) {
  Builder builder;
  const auto x = builder.input(0), y = builder.input(1), z = builder.input(2);
  std::vector<std::pair<std::string, program::Field>> outputs;
  outputs.emplace_back("inside", builder.constant(1));
  for (int channel = 0; channel < 4; ++channel) outputs.emplace_back("c", builder.source(source, channel, x, y, z));
  outputs.emplace_back("other", builder.source(source, 1, y, x, z));
  return builder.finish(outputs);
}

class PointRows : public SourceRows {
 public:
  bool has(const program::Read&) const override { return false; }
  void fill(const program::Read&, const RowsToFill&) const override {}
};

// Points along x, of which y marks each third.
struct MarkedRow {
  std::vector<float> xs, ys, zs;
  std::vector<double> marked;  // their x

  MarkedRow() {
    for (size_t n = 0; n < padded(200); ++n) {
      xs.push_back(static_cast<float>(n));
      ys.push_back(n % 3 == 0 ? 1 : 0);
      zs.push_back(0);
      if (n % 3 == 0) marked.push_back(static_cast<double>(n));
    }
  }
  PointList points() const { return {xs, ys, zs}; }
  size_t size() const { return xs.size(); }
};

// Evaluates output 0 at a list of points.
class ListEvaluation {
 public:
  ListEvaluation(const program::Program& program, const PointList& points, size_t count,
                 BatchEvaluator::Finish finish = BatchEvaluator::Finish::everywhere)
      : batch(kernel_sets().front(), finish) {
    const std::vector<Interval> ranges(program.code.size(), Interval::everything());
    batch.compile_for_list(program, ranges, count, rows_);
    batch.place(points);
    batch.begin_layer(0);
    batch.begin_row(0);
  }

  BatchEvaluator batch;

 private:
  PointRows rows_;
};

}  // namespace

TEST(Channels, ReferenceAsksForThemTogether) {
  const auto source = std::make_shared<FourChannels>();
  const program::Program program = program_of(source);
  RowEvaluator rows(3);
  const std::vector<double> xs{1, 2, 4};
  rows.set_row(xs, 0.5, 7);
  rows.run(program, 0, program.code.size(), nullptr);
  EXPECT_EQ(source->group_sizes, (std::vector<size_t>{4, 1}));
  for (int channel = 0; channel < 4; ++channel)
    for (size_t n = 0; n < xs.size(); ++n)
      EXPECT_EQ(rows.values(program.outputs[static_cast<size_t>(channel) + 1])[n], xs[n] + channel * 0.5);
  for (size_t n = 0; n < xs.size(); ++n) EXPECT_EQ(rows.values(program.outputs[5])[n], 0.5 + xs[n]);
}

TEST(Channels, BatchesAskForThemTogether) {
  if (kernel_sets().empty()) GTEST_SKIP() << "no instruction set for batches";
  const auto source = std::make_shared<FourChannels>();
  const program::Program program = program_of(source);
  std::vector<float> xs, ys, zs;
  for (size_t n = 0; n < padded(200); ++n) {
    xs.push_back(static_cast<float>(n));
    ys.push_back(static_cast<float>(n % 7));
    zs.push_back(0);
  }
  ListEvaluation evaluation(program, PointList{xs, ys, zs}, xs.size());
  BatchEvaluator& batch = evaluation.batch;
  batch.finish_row();
  // Sources are sampled at 128 points at a time.
  EXPECT_EQ(source->group_sizes, (std::vector<size_t>{4, 4, 1, 1}));
  for (size_t channel = 0; channel < 4; ++channel)
    for (size_t n = 0; n < xs.size(); ++n)
      ASSERT_EQ(batch.output(channel + 1)[n], xs[n] + static_cast<float>(channel) * ys[n]);
  for (size_t n = 0; n < xs.size(); ++n) ASSERT_EQ(batch.output(5)[n], ys[n] + xs[n]);
}

// A source is not sampled where output 0 is 0, since outputs are undefined there.
TEST(Channels, AreQueriedOnlyInside) {
  if (kernel_sets().empty()) GTEST_SKIP() << "no instruction set for batches";
  const auto source = std::make_shared<QueriedPoints>();
  Builder builder;
  const auto x = builder.input(0), y = builder.input(1), z = builder.input(2);
  const program::Program program = builder.finish({{"inside", y}, {"value", builder.source(source, 0, x, y, z)}});
  const MarkedRow row;
  ListEvaluation evaluation(program, row.points(), row.size());
  BatchEvaluator& batch = evaluation.batch;
  batch.finish_row_inside();
  EXPECT_EQ(source->queried, row.marked);
  for (size_t n = 0; n < row.size(); n += 3) ASSERT_EQ(batch.output(1)[n], row.xs[n]);
  batch.finish_row();
  EXPECT_EQ(source->queried.size(), row.marked.size() + row.size());
}

// A cheap condition decides where an expensive source is sampled, though it comes later in the program.
TEST(Channels, AreNotQueriedWhereACheaperConditionFails) {
  if (kernel_sets().empty()) GTEST_SKIP() << "no instruction set for batches";
  const MarkedRow row;
  const auto queries_of = [&](bool is_alone) {
    const auto source = std::make_shared<QueriedPoints>();
    Builder builder;
    const auto x = builder.input(0), y = builder.input(1), z = builder.input(2);
    const auto large = program::less(builder.constant(100), builder.source(source, 0, x, y, z));
    const auto both = program::logical_and(large, y);
    const program::Program program =
        builder.finish({{"inside", is_alone ? both : program::logical_or(both, builder.constant(0.5) * large)}});
    ListEvaluation evaluation(program, row.points(), row.size(), BatchEvaluator::Finish::inside);
    for (size_t n = 0; n < row.size(); ++n) {
      const bool is_inside = n > 100 && (!is_alone || n % 3 == 0);
      EXPECT_EQ(evaluation.batch.output(0)[n] != 0, is_inside);
    }
    return source->queried;
  };
  EXPECT_EQ(queries_of(true), row.marked);
  EXPECT_EQ(queries_of(false).size(), row.size()) << "other ways lead to the output";
}

}  // namespace ombre::eval

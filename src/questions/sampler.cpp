#include "questions/sampler.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "eval/rows.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

constexpr size_t block_points = 256;

// Spreads the ten lowest bits of `v` to every third bit of the result.
uint32_t spread(uint32_t v) {
  v = (v | (v << 16)) & 0x030000FFU;
  v = (v | (v << 8)) & 0x0300F00FU;
  v = (v | (v << 4)) & 0x030C30C3U;
  return (v | (v << 2)) & 0x09249249U;
}

// A block of points that are evaluated together: a range of the order along the curve.
struct Block {
  size_t begin = 0, end = 0;
};

void add_blocks(size_t begin, size_t end, std::vector<Block>& blocks) {
  for (; begin < end; begin += block_points) blocks.push_back({begin, std::min(begin + block_points, end)});
}

// Orders points along a Z curve and divides them into blocks, each of which lies in a cell of an octree, so that few of
// many parts reach one block.
class Curve {
 public:
  explicit Curve(std::span<const Vec3> points) : keys_(points.size(), 0), order_(points.size()) {
    Box box;
    for (const Vec3& p : points)
      if (is_finite(p)) box = hull(box, Box{p, p});
    for (size_t n = 0; n < points.size(); ++n) {
      for (int axis = 0; axis < 3; ++axis) {
        const double extent = box.hi[axis] - box.lo[axis];
        const double t = extent > 0 ? (points[n][axis] - box.lo[axis]) / extent * 1023 : 0;
        keys_[n] |= spread(t >= 0 && t <= 1023 ? static_cast<uint32_t>(t) : 0) << axis;
      }
    }
    std::iota(order_.begin(), order_.end(), 0U);
    std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) { return keys_[a] < keys_[b]; });
    cut(0, order_.size(), 0, first_digit);
  }

  const std::vector<uint32_t>& order() const { return order_; }
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  static constexpr int first_digit = 27;  // lowest bit of the first digit; each of the ten levels has three bits

  // Cuts the points from `begin` to `end`, which lie in the cell whose keys equal `key` above the digit.
  void cut(size_t begin, size_t end, uint32_t key, int digit) {
    if (end - begin <= block_points || digit < 0) return add_blocks(begin, end, blocks_);
    for (uint32_t n = 0; n < 8 && begin < end; ++n) {
      const uint32_t last = key + ((n + 1) << digit) - 1;
      const auto behind = std::partition_point(order_.begin() + static_cast<ptrdiff_t>(begin),
                                               order_.begin() + static_cast<ptrdiff_t>(end),
                                               [&](uint32_t point) { return keys_[point] <= last; });
      const auto next = static_cast<size_t>(behind - order_.begin());
      cut(begin, next, key + (n << digit), digit - 3);
      begin = next;
    }
  }

  std::vector<uint32_t> keys_, order_;
  std::vector<Block> blocks_;
};

// Returns the program in which the many parts that reach the box are written out.
program::Program parts_within(const program::Program& program, const Box& box) {
  std::vector<Interval> ranges;
  program::evaluate_intervals(program, box, ranges);
  return program::expand_parts(program, ranges, program::Precision::reference);
}

}  // namespace

std::optional<Sampler> Sampler::build(const design::Design& design, const SampleQuery& query,
                                      Diagnostics& diagnostics) {
  using Kind = Column::Kind;
  Question question(design, {.parts = query.parts});
  Sampler sampler;
  program::Outputs outputs;
  const auto add = [&](Kind kind, const std::string& name, program::Field field, MaterialId material = 0) {
    sampler.columns_.push_back({kind, name, material, {}});
    outputs.emplace_back(name, field);
  };
  if (query.inside) add(Kind::inside, "inside", question.inside());
  if (query.distance) add(Kind::distance, "distance", question.distance());
  if (query.fractions)
    for (const auto& [id, fraction] : question.composition().fractions)
      add(Kind::fraction, design.materials.all()[id].name, fraction, id);
  for (const std::string& name : query.attributes) {
    const auto value = question.attribute(name, diagnostics);
    if (!value) return std::nullopt;
    add(Kind::attribute, name, *value);
  }
  if (query.parts)
    for (size_t n = 0; n < design.parts.size(); ++n) add(Kind::part, design.parts[n].name, question.part(n));
  if (query.checks)
    for (const auto& [number, flag] : question.composition().checks) {
      const design::Check& check = question.check(number);
      add(Kind::check, check.message, flag);
      sampler.columns_.back().where = check.where;
    }
  auto program = question.program(outputs, diagnostics);
  if (!program) return std::nullopt;
  sampler.program_ = std::move(*program);
  sampler.stages_ = question.stages();
  return sampler;
}

void Sampler::sample(std::span<const Vec3> points, std::span<double* const> columns, int threads,
                     const StopFlag* stop) const {
  StageLoan loan;
  loan.threads = threads;
  loan.stop = stop;
  stages_->prepare(loan);
  std::vector<uint32_t> order;
  std::vector<Block> blocks;
  if (program_.has_parts()) {
    const Curve curve(points);
    order = curve.order();
    blocks = curve.blocks();
  } else {
    order.resize(points.size());
    std::iota(order.begin(), order.end(), 0U);
    add_blocks(0, points.size(), blocks);
  }
  run_parallel(blocks.size(), threads, [&](size_t n) {
    if (stop && stop->requested()) throw Cancelled();
    sample_block(points, order.data() + blocks[n].begin, blocks[n].end - blocks[n].begin, columns);
  });
}

void Sampler::sample_block(std::span<const Vec3> points, const uint32_t* order, size_t count,
                           std::span<double* const> columns) const {
  std::array<std::array<double, block_points>, 3> coordinates;
  Box box;
  for (size_t n = 0; n < count; ++n) {
    const Vec3 p = points[order[n]];
    for (int axis = 0; axis < 3; ++axis) coordinates[static_cast<size_t>(axis)][n] = p[axis];
    box = hull(box, Box{p, p});
  }
  const program::Program here = program_.has_parts() ? parts_within(program_, box) : program::Program();
  const program::Program& program = program_.has_parts() ? here : program_;
  eval::RowEvaluator evaluator(count);
  const auto axis = [&](size_t a) { return std::span<const double>(coordinates[a].data(), count); };
  evaluator.set_points(axis(0), axis(1), axis(2));
  evaluator.run(program, 0, program.code.size(), nullptr);
  for (size_t c = 0; c < columns_.size(); ++c) {
    const std::span<const double> values = evaluator.values(program.outputs[c]);
    for (size_t n = 0; n < count; ++n) columns[c][order[n]] = values[n];
  }
}

}  // namespace ombre::compile

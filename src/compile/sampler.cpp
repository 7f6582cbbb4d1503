#include "compile/sampler.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/error.h"
#include "base/tasks.h"
#include "compile/question.h"
#include "eval/rows.h"
#include "program/passes/passes.h"

namespace ombre::compile {
namespace {

constexpr size_t block_points = 256;

// Every third bit of the result is one of the ten lowest of `v`.
uint32_t spread(uint32_t v) {
  v = (v | (v << 16)) & 0x030000FFU;
  v = (v | (v << 8)) & 0x0300F00FU;
  v = (v | (v << 4)) & 0x030C30C3U;
  return (v | (v << 2)) & 0x09249249U;
}

// Points in the order of a Z curve: what follows one another lies close together, so that few of many parts reach
// a block of them.
std::vector<uint32_t> along_curve(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points)
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) box = hull(box, Box{p, p});
  std::vector<uint32_t> keys(points.size(), 0), order(points.size());
  for (size_t n = 0; n < points.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = box.hi[axis] - box.lo[axis];
      const double t = extent > 0 ? (points[n][axis] - box.lo[axis]) / extent * 1023 : 0;
      keys[n] |= spread(t >= 0 && t <= 1023 ? static_cast<uint32_t>(t) : 0) << axis;
    }
  }
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

// The program with those of many parts written out that reach the box.
program::Program parts_within(const program::Program& program, const Box& box) {
  std::vector<Interval> ranges;
  program::evaluate_intervals(program, box, ranges);
  return program::expand_parts(program, ranges, program::Precision::reference);
}

}  // namespace

std::optional<Sampler> Sampler::build(const design::Design& design, const SampleWishes& wishes,
                                      Diagnostics& diagnostics) {
  using Kind = Column::Kind;
  Question question(design, {.parts = wishes.parts});
  Sampler sampler;
  program::Outputs outputs;
  const auto add = [&](Kind kind, const std::string& name, program::Field field, MaterialId material = 0) {
    sampler.columns_.push_back({kind, name, material});
    outputs.emplace_back(name, field);
  };
  if (wishes.inside) add(Kind::inside, "inside", question.inside());
  if (wishes.distance) add(Kind::distance, "distance", question.distance());
  if (wishes.fractions)
    for (const auto& [id, fraction] : question.composition().fractions)
      add(Kind::fraction, design.materials.all()[id].name, fraction, id);
  for (const std::string& name : wishes.attributes) {
    const auto value = question.attribute(name, diagnostics);
    if (!value) return std::nullopt;
    add(Kind::attribute, name, *value);
  }
  if (wishes.parts)
    for (size_t n = 0; n < design.parts.size(); ++n) add(Kind::part, design.parts[n].name, question.part(n));
  auto program = question.program(outputs, diagnostics);
  if (!program) return std::nullopt;
  sampler.program_ = std::move(*program);
  return sampler;
}

void Sampler::sample(std::span<const Vec3> points, std::span<double* const> columns, int threads,
                     const StopFlag* stop) const {
  std::vector<uint32_t> order;
  if (program_.has_parts()) {
    order = along_curve(points);
  } else {
    order.resize(points.size());
    std::iota(order.begin(), order.end(), 0U);
  }
  const size_t blocks = (points.size() + block_points - 1) / block_points;
  run_parallel(blocks, threads, [&](size_t block) {
    if (stop && stop->requested()) throw Cancelled();
    const size_t begin = block * block_points;
    sample_block(points, order.data() + begin, std::min(block_points, points.size() - begin), columns);
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

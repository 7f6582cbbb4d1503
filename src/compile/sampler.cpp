#include "compile/sampler.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/error.h"
#include "base/tasks.h"
#include "base/text.h"
#include "compile/build.h"
#include "design/lowering.h"
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

std::vector<std::string> attribute_names(const design::Design& design) {
  const design::LoweringContext context(design.materials, design.roots());
  std::vector<std::string> names;
  for (const auto& attribute : context.attributes()) names.push_back(attribute.name);
  return names;
}

std::optional<Sampler> Sampler::build(const design::Design& design, const SampleWishes& wishes,
                                      Diagnostics& diagnostics) {
  using Kind = Column::Kind;
  const std::vector<std::string> known = attribute_names(design);
  for (const std::string& name : wishes.attributes) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    diagnostics.error(
        design.parts[0].solid->where(), "the design has no attribute \"" + name + "\"",
        known.empty() ? "give it one with attribute(\"" + name + "\", value)" : "it has " + join(known, ", "));
    return std::nullopt;
  }
  const design::NodePtr solid = whole_solid(design);
  std::vector<design::NodePtr> roots = design.roots();
  roots.push_back(solid);
  design::LoweringContext context(design.materials, roots, design.voxel_mm());
  program::Builder builder;
  design::Lowering lowering(context, builder);
  const program::Point p = program::Point::origin_frame(builder);
  Sampler sampler;
  std::vector<std::pair<std::string, program::Field>> outputs;
  const auto add = [&](Kind kind, const std::string& name, program::Field field, MaterialId material = 0) {
    sampler.columns_.push_back({kind, name, material});
    outputs.emplace_back(name, field);
  };
  if (wishes.inside) add(Kind::inside, "inside", lowering.inside(*solid, p));
  if (wishes.distance) add(Kind::distance, "distance", lowering.distance(*solid, p));
  if (wishes.fractions)
    for (const auto& [id, fraction] : lowering.composition(*solid, p, design::Demand::inside).fractions)
      add(Kind::fraction, design.materials.all()[id].name, fraction, id);
  for (const std::string& name : wishes.attributes)
    add(Kind::attribute, name, lowering.attribute(*solid, name, p, design::Demand::inside));
  if (wishes.parts)
    for (const design::Part& part : design.parts) add(Kind::part, part.name, lowering.inside(*part.solid, p));
  context.finish_bodies();
  auto flat = flatten(builder.finish(outputs), solid->where(), diagnostics);
  if (!flat) return std::nullopt;
  sampler.program_ = std::move(*flat);
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

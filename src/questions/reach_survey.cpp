#include "questions/reach_survey.h"

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "program/evaluate.h"
#include "questions/question.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using voxel::TileBox;

constexpr int64_t leaf_voxels = 4096;
constexpr size_t points_of_batch = size_t{1} << 18;

// Widens a reach by what rounding of its ends and of values may take.
Interval with_rounding(const Interval& reach) {
  constexpr double share = 1e-9;
  return {reach.lo - share * std::abs(reach.lo), reach.hi + share * std::abs(reach.hi)};
}

double beyond(double value, const Interval& reach) {
  return value < reach.lo ? reach.lo - value : value > reach.hi ? value - reach.hi : 0;
}

class ReachSurvey {
 public:
  ReachSurvey(const program::Program& ranges, const Sampler& sampler, const voxel::Lattice& lattice,
              const std::vector<AttributeReach>& reaches, int threads, const StopFlag* stop)
      : ranges_(ranges),
        sampler_(sampler),
        lattice_(lattice),
        threads_(threads),
        stop_(stop),
        found_(reaches.size()),
        farthest_(reaches.size(), 0) {
    for (const AttributeReach& reach : reaches) reaches_.push_back(with_rounding(reach.reach));
  }

  std::vector<OutOfReach> run() {
    visit({{0, 0, 0}, lattice_.count});
    take_points();
    return found_;
  }

 private:
  void visit(const TileBox& box) {
    if (stop_ && stop_->requested()) throw Cancelled();
    if (is_settled(box)) return;
    size_t longest = 0;
    int64_t voxels = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      voxels *= box.hi[axis] - box.lo[axis];
      if (box.hi[axis] - box.lo[axis] > box.hi[longest] - box.lo[longest]) longest = axis;
    }
    if (voxels <= leaf_voxels) return add_points(box);
    TileBox first = box, second = box;
    first.hi[longest] = second.lo[longest] = box.lo[longest] + (box.hi[longest] - box.lo[longest]) / 2;
    visit(first);
    visit(second);
  }

  // True if intervals show that nothing of the box is inside, or that all of it is within reach.
  bool is_settled(const TileBox& box) {
    const Vec3 lo = lattice_.center(box.lo[0], box.lo[1], box.lo[2]);
    const Vec3 hi = lattice_.center(box.hi[0] - 1, box.hi[1] - 1, box.hi[2] - 1);
    program::evaluate_intervals(ranges_, {lo, hi}, intervals_);
    if (is_zero(intervals_[ranges_.outputs[0]])) return true;
    for (size_t n = 0; n < reaches_.size(); ++n) {
      const Interval& values = intervals_[ranges_.outputs[n + 1]];
      if (!(values.lo >= reaches_[n].lo && values.hi <= reaches_[n].hi)) return false;
    }
    return true;
  }

  void add_points(const TileBox& box) {
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j)
        for (int64_t i = box.lo[0]; i < box.hi[0]; ++i) points_.push_back(lattice_.center(i, j, k));
    if (points_.size() >= points_of_batch) take_points();
  }

  void take_points() {
    std::vector<std::vector<double>> values(reaches_.size() + 1, std::vector<double>(points_.size()));
    std::vector<double*> columns;
    for (auto& column : values) columns.push_back(column.data());
    sampler_.sample(points_, columns, threads_, stop_);
    for (size_t point = 0; point < points_.size(); ++point)
      for (size_t n = 0; n < reaches_.size() && values[0][point] != 0; ++n)
        take(n, points_[point], values[n + 1][point]);
    points_.clear();
  }

  void take(size_t n, const Vec3& point, double value) {
    const double distance = beyond(value, reaches_[n]);
    if (distance <= 0) return;
    OutOfReach& found = found_[n];
    const bool is_before = std::pair(point.z, std::pair(point.y, point.x)) <
                           std::pair(found.worst_mm.z, std::pair(found.worst_mm.y, found.worst_mm.x));
    if (found.voxels++ > 0 && (distance < farthest_[n] || (distance == farthest_[n] && !is_before))) return;
    farthest_[n] = distance;
    found.worst = value;
    found.worst_mm = point;
  }

  const program::Program& ranges_;
  const Sampler& sampler_;
  const voxel::Lattice& lattice_;
  std::vector<Interval> reaches_;
  int threads_;
  const StopFlag* stop_;
  std::vector<Interval> intervals_;
  std::vector<Vec3> points_;
  std::vector<OutOfReach> found_;
  std::vector<double> farthest_;
};

}  // namespace

std::optional<std::vector<OutOfReach>> survey_reach(const design::Design& design, const voxel::Lattice& lattice,
                                                    const std::vector<AttributeReach>& reaches, int threads,
                                                    const StopFlag* stop, Diagnostics& diagnostics) {
  Question question(design);
  SampleQuery query;
  query.inside = true;
  program::Outputs outputs{{"inside", question.inside()}};
  for (const AttributeReach& reach : reaches) {
    const auto value = question.attribute(reach.attribute, diagnostics);
    if (!value) return std::nullopt;
    outputs.emplace_back(reach.attribute, *value);
    query.attributes.push_back(reach.attribute);
  }
  const auto ranges = question.program(outputs, diagnostics);
  const auto sampler = ranges ? Sampler::build(design, query, diagnostics) : std::nullopt;
  if (!sampler) return std::nullopt;
  return ReachSurvey(*ranges, *sampler, lattice, reaches, threads, stop).run();
}

}  // namespace ombre::compile

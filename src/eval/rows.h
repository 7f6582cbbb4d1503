// Evaluates programs over rows of points in double precision, one op at a time; this is the reference.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "program/program.h"

namespace ombre::eval {

// Fills `values` with a source's values along the row. Returns false if it cannot; then the source is evaluated at each
// point.
using SourceRow = std::function<bool(const program::Read&, std::span<double> values)>;

// Computes the values of a program's instructions at up to `width` points. Results are bit-identical to those of
// evaluate_point.
class RowEvaluator {
 public:
  explicit RowEvaluator(size_t width) : width_(width) {}

  size_t width() const { return width_; }
  // Sets the points to (xs[n], y, z), or to (xs[n], ys[n], zs[n]). One of the two functions must be called before run.
  void set_row(std::span<const double> xs, double y, double z);
  void set_points(std::span<const double> xs, std::span<const double> ys, std::span<const double> zs);
  // Runs instructions [begin, end). Those before `begin` must have been run on this row.
  void run(const program::Program& program, size_t begin, size_t end, const SourceRow& source_row);
  std::span<const double> values(program::ValueId id) const { return {values_.get() + id * width_, xs_.size()}; }

 private:
  void run_input(int axis, double* out) const;
  // Samples the source of instruction i, and of the instructions before `end` that read other channels of that source
  // at the same points.
  void run_source(const program::Program& program, size_t i, size_t end, const SourceRow& source_row);
  double* row(program::ValueId id) { return values_.get() + id * width_; }
  void make_room(const program::Program& program);

  size_t width_;
  std::span<const double> xs_, ys_, zs_;  // ys_ and zs_ are empty if the points are a row along x
  double y_ = 0, z_ = 0;
  std::unique_ptr<double[]> values_;  // `width_` values for each instruction
  size_t room_ = 0;                   // number of instructions that values_ has room for
  std::vector<Vec3> points_;          // points at which a source is sampled
  std::vector<bool> done_;            // instructions that were sampled together with another channel
  std::vector<int> channels_;
  std::vector<double*> channel_rows_;
};

}  // namespace ombre::eval

// Evaluates programs over rows of points in double precision: the reference, one op at a time.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "program/program.h"

namespace ombre::eval {

// Fills values with a source's answers along the row; false if it has none, and the source is evaluated point by point.
using SourceRow = std::function<bool(const program::Read&, std::span<double> values)>;

// Holds the values of a program's instructions at up to `width` points. Every value has the bits that
// evaluate_point gives.
class RowEvaluator {
 public:
  explicit RowEvaluator(size_t width) : width_(width) {}

  size_t width() const { return width_; }
  // Points (xs[n], y, z), or (xs[n], ys[n], zs[n]). Call one of them before run.
  void set_row(std::span<const double> xs, double y, double z);
  void set_points(std::span<const double> xs, std::span<const double> ys, std::span<const double> zs);
  // Instructions [begin, end); those before `begin` were run on this row already.
  void run(const program::Program& program, size_t begin, size_t end, const SourceRow& source_row);
  std::span<const double> values(program::ValueId id) const { return {values_.get() + id * width_, xs_.size()}; }

 private:
  void run_input(int axis, double* out) const;
  // Instruction i, and those like it before `end` that ask the same source at the same points for other channels.
  void run_source(const program::Program& program, size_t i, size_t end, const SourceRow& source_row);
  double* row(program::ValueId id) { return values_.get() + id * width_; }
  void make_room(const program::Program& program);

  size_t width_;
  std::span<const double> xs_, ys_, zs_;  // ys_ and zs_ are empty where the points are a row
  double y_ = 0, z_ = 0;
  std::unique_ptr<double[]> values_;  // of instructions, each at `width_` points
  size_t room_ = 0;                   // for so many instructions
  std::vector<Vec3> points_;          // of a source
  std::vector<bool> done_;            // together with another channel
  std::vector<int> channels_;
  std::vector<double*> channel_rows_;
};

}  // namespace ombre::eval

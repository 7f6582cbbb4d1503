#include "eval/rows.h"

#include <algorithm>

#include "base/math/math_rows.h"
#include "base/system/assert.h"

namespace ombre::eval {

using program::Instruction;
using program::Op;
using program::Program;

namespace {

// Returns the function that computes an op for a row of numbers, or null if there is none.
math::RowFunction row_function(Op op) {
  static const math::RowFunctions best = math::row_functions().front();
  switch (op) {
#define OMBRE_ROW_FUNCTION(name) \
  case Op::name:                 \
    return best.name;
    OMBRE_ELEMENTARY_FUNCTIONS(OMBRE_ROW_FUNCTION)
#undef OMBRE_ROW_FUNCTION
    default:
      return nullptr;
  }
}

// Number of following instructions that are searched for other channels of the same source.
constexpr size_t channel_reach = 32;

bool is_other_channel(const Program& program, const Instruction& in, const Instruction& other) {
  return other.op == Op::source && other.a == in.a && other.b == in.b && other.c == in.c &&
         program.reads[other.aux].source == program.reads[in.aux].source;
}

}  // namespace

void RowEvaluator::set_row(std::span<const double> xs, double y, double z) {
  ASSERT(xs.size() <= width_);
  xs_ = xs;
  ys_ = zs_ = {};
  y_ = y;
  z_ = z;
}

void RowEvaluator::set_points(std::span<const double> xs, std::span<const double> ys, std::span<const double> zs) {
  ASSERT(xs.size() <= width_ && ys.size() == xs.size() && zs.size() == xs.size());
  xs_ = xs;
  ys_ = ys;
  zs_ = zs;
}

void RowEvaluator::run_input(int axis, double* out) const {
  const std::span<const double> given = axis == 0 ? xs_ : axis == 1 ? ys_ : zs_;
  if (given.empty())
    std::fill_n(out, xs_.size(), axis == 1 ? y_ : z_);
  else
    std::copy_n(given.data(), given.size(), out);
}

// Allocates memory without initialising it, since all values are written before they are read.
void RowEvaluator::make_room(const Program& program) {
  if (program.code.size() <= room_) return;
  values_ = std::make_unique_for_overwrite<double[]>(program.code.size() * width_);
  room_ = program.code.size();
}

void RowEvaluator::run(const Program& program, size_t begin, size_t end, const SourceRow& source_row) {
  make_room(program);
  const size_t n = xs_.size();
  if (!program.reads.empty()) done_.assign(program.code.size(), false);
  for (size_t i = begin; i < end; ++i) {
    const Instruction& in = program.code[i];
    double* out = row(static_cast<program::ValueId>(i));
    const double *a = row(in.a), *b = row(in.b), *c = row(in.c);
    if (const math::RowFunction function = row_function(in.op)) {
      function(a, out, n);
      continue;
    }
    switch (in.op) {
      case Op::input:
        run_input(static_cast<int>(in.value), out);
        break;
      case Op::constant:
        std::fill_n(out, n, in.value);
        break;
      case Op::affine: {
        const program::AffineRow& m = program.maps[in.aux];
        for (size_t p = 0; p < n; ++p) out[p] = program::apply_affine(m, a[p], b[p], c[p]);
        break;
      }
      case Op::source:
        run_source(program, i, end, source_row);
        break;
      case Op::call:
      case Op::parts:
        ASSERT(false && "calls and parts are written out before evaluation");
        break;
#define OMBRE_LANE_1(name) math::name(a[p])
#define OMBRE_LANE_2(name) math::name(a[p], b[p])
#define OMBRE_LANE_3(name) math::name(a[p], b[p], c[p])
#define OMBRE_ROW(name, arity)                                        \
  case Op::name:                                                      \
    for (size_t p = 0; p < n; ++p) out[p] = OMBRE_LANE_##arity(name); \
    break;
        OMBRE_OPS(OMBRE_ROW)
#undef OMBRE_ROW
#undef OMBRE_LANE_1
#undef OMBRE_LANE_2
#undef OMBRE_LANE_3
    }
  }
}

void RowEvaluator::run_source(const Program& program, size_t i, size_t end, const SourceRow& source_row) {
  if (done_[i]) return;
  const Instruction& in = program.code[i];
  const program::Read& read = program.reads[in.aux];
  const size_t n = xs_.size();
  if (source_row && source_row(read, {row(static_cast<program::ValueId>(i)), n})) return;
  channels_.assign(1, read.channel);
  channel_rows_.assign(1, row(static_cast<program::ValueId>(i)));
  for (size_t other = i + 1; other < std::min(end, i + channel_reach); ++other) {
    double* const out = row(static_cast<program::ValueId>(other));
    if (!is_other_channel(program, in, program.code[other])) continue;
    done_[other] = true;
    const program::Read& its = program.reads[program.code[other].aux];
    if (source_row && source_row(its, {out, n})) continue;
    channels_.push_back(its.channel);
    channel_rows_.push_back(out);
  }
  const double *a = row(in.a), *b = row(in.b), *c = row(in.c);
  points_.clear();
  for (size_t p = 0; p < n; ++p) points_.push_back({a[p], b[p], c[p]});
  read.source->sample_channels(channels_, points_, channel_rows_);
}

}  // namespace ombre::eval

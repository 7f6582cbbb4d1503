#include "program/evaluate.h"

#include "base/system/assert.h"
#include "program/parts.h"
#include "program/quick_intervals.h"
#include "program/single.h"

namespace ombre::program {
namespace {

Interval apply_reference(Op op, Interval a, Interval b, Interval c) {
  if (const Interval quick = quick_interval(op, a, b, [](double v) { return v; }); !std::isnan(quick.lo)) return quick;
  const int arity = info(op).arity;
  const bool known = a.is_point() && (arity < 2 || b.is_point()) && (arity < 3 || c.is_point());
  if (!known) return apply(op, a, b, c);
  const double value = apply(op, a.lo, b.lo, c.lo);
  return std::isnan(value) ? Interval::everything() : Interval(value);
}

}  // namespace

Interval apply_interval(const Instruction& in, Interval a, Interval b, Interval c, Precision precision) {
  const bool is_quotient = in.op == Op::divide || in.op == Op::share;
  const bool of_itself = is_quotient && in.a == in.b && a.is_bounded();
  if (of_itself && (a.lo > 0 || (a.hi < 0 && in.op == Op::divide))) return 1;
  return precision == Precision::batch ? apply_single(in.op, a, b, c) : apply_reference(in.op, a, b, c);
}

void evaluate_intervals(const Program& program, const Box& box, std::vector<Interval>& values,
                        const SourceRanges& source_ranges, Precision precision) {
  const bool batch = precision == Precision::batch;
  const auto rounded = [&](Interval v) { return batch ? to_single(v) : v; };
  struct {
    const PartSet* set = nullptr;
    Box where;
    bool reaches = false;
  } last_query;
  values.resize(program.code.size());
  for (size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& in = program.code[i];
    const Interval &a = values[in.a], &b = values[in.b], &c = values[in.c];
    switch (in.op) {
      case Op::input:
        values[i] = rounded(box.axis(static_cast<int>(in.value)));
        break;
      case Op::constant:
        values[i] = std::isnan(in.value) ? Interval::everything() : rounded(in.value);
        break;
      case Op::affine:
        ASSERT(!batch && "batches have fused multiplications and additions instead");
        values[i] = apply_affine(program.maps[in.aux], a, b, c);
        break;
      case Op::source: {
        const Read& read = program.reads[in.aux];
        const Box where{{a.lo, b.lo, c.lo}, {a.hi, b.hi, c.hi}};
        values[i] = rounded(source_ranges ? source_ranges(read, where) : read.source->range(read.channel, where));
        break;
      }
      case Op::call:
        ASSERT(false && "calls are inlined before evaluation");
        break;
      case Op::parts: {
        const Box where{{a.lo, b.lo, c.lo}, {a.hi, b.hi, c.hi}};
        const PartSet& set = *program.part_sets[in.aux];
        // Consecutive instructions often ask for slots of one set at one place.
        if (last_query.set != &set || last_query.where != where) last_query = {&set, where, set.index.reaches(where)};
        values[i] = last_query.reaches ? set.ranges[static_cast<size_t>(in.value)] : Interval(0);
        break;
      }
      default:
        values[i] = apply_interval(in, a, b, c, precision);
    }
  }
}

void evaluate_point(const Program& program, Vec3 p, std::vector<double>& values) {
  values.resize(program.code.size());
  for (size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& in = program.code[i];
    const double a = values[in.a], b = values[in.b], c = values[in.c];
    switch (in.op) {
      case Op::input:
        values[i] = p[static_cast<int>(in.value)];
        break;
      case Op::constant:
        values[i] = in.value;
        break;
      case Op::affine:
        values[i] = apply_affine(program.maps[in.aux], a, b, c);
        break;
      case Op::source:
        values[i] = program.reads[in.aux].source->sample(program.reads[in.aux].channel, {a, b, c});
        break;
      case Op::call:
      case Op::parts:
        ASSERT(false && "calls and parts are written out before evaluation");
        break;
      default:
        values[i] = apply(in.op, a, b, c);
    }
  }
}

}  // namespace ombre::program

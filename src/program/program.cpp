// Prints and evaluates programs, one instruction at a time.
#include "program/program.h"

#include <map>

#include "base/assert.h"
#include "base/text.h"
#include "program/parts.h"
#include "program/passes/replay.h"
#include "program/quick_intervals.h"
#include "program/single.h"

namespace ombre::program {
namespace {

std::string operands(const Instruction& in, int arity) {
  std::string text;
  const ValueId ids[] = {in.a, in.b, in.c};
  for (int i = 0; i < arity; ++i) text += " v" + std::to_string(ids[i]);
  return text;
}

std::string describe(const Program& program, const Instruction& in, std::map<const Program*, size_t>& bodies) {
  const OpInfo op = info(in.op);
  std::string text(op.name);
  switch (in.op) {
    case Op::input:
      return text + " " + std::string(1, static_cast<char>('x' + static_cast<int>(in.value)));
    case Op::constant:
      return text + " " + format_number(in.value);
    case Op::affine: {
      text += " [";
      for (const double m : program.maps[in.aux]) text += format_number(m) + " ";
      text.back() = ']';
      break;
    }
    case Op::source: {
      const Read& read = program.reads[in.aux];
      text += " \"" + read.source->name() + "\" channel " + std::to_string(read.channel);
      break;
    }
    case Op::call: {
      const Call& call = program.calls[in.aux];
      const size_t number = bodies.try_emplace(call.body.get(), bodies.size()).first->second;
      text += " body" + std::to_string(number) + "." + call.body->output_names[call.output];
      break;
    }
    case Op::parts: {
      const PartSet& set = *program.part_sets[in.aux];
      text += " slot " + format_number(in.value) + " of " + std::to_string(set.reference.size()) + " parts in " +
              std::to_string(set.reference.body_count()) + " kinds at";
      break;
    }
    default:
      break;
  }
  return text + operands(in, op.arity);
}

// How often a value is computed that depends on these axes.
std::string_view place(uint8_t mask) {
  constexpr std::string_view places[] = {
      "once", "each x", "each y", "each x and y", "each layer", "each x of each layer", "each row", "each voxel"};
  return places[mask];
}

void print(const Program& program, std::string& text, std::map<const Program*, size_t>& bodies) {
  const std::vector<uint8_t> masks = axis_masks(program);
  for (size_t i = 0; i < program.code.size(); ++i) {
    std::string line = "  v" + std::to_string(i) + " = " + describe(program, program.code[i], bodies);
    constexpr size_t column = 48;
    line.resize(std::max(line.size() + 2, column), ' ');
    text += line + "; " + std::string(place(masks[i])) + "\n";
  }
  for (size_t i = 0; i < program.outputs.size(); ++i)
    text += "  " + program.output_names[i] + " = v" + std::to_string(program.outputs[i]) + "\n";
}

}  // namespace

std::string to_text(const Program& program) {
  std::string text = "program\n";
  std::map<const Program*, size_t> bodies;
  print(program, text, bodies);
  // Printing a body may find further bodies.
  for (size_t done = 0; done < bodies.size(); ++done) {
    const Program* body = nullptr;
    for (const auto& [candidate, number] : bodies)
      if (number == done) body = candidate;
    text += "body" + std::to_string(done) + "\n";
    ASSERT(body);  // numbers count up from 0
    print(*body, text, bodies);
  }
  return text;
}

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
  } asked;
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
        // Slots of one set at one place follow each other.
        if (asked.set != &set || asked.where != where) asked = {&set, where, set.index.reaches(where)};
        values[i] = asked.reaches ? set.ranges[static_cast<size_t>(in.value)] : Interval(0);
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

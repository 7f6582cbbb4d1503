// Programs, the linear form of fields. The operands of each instruction come before it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "program/field_source.h"
#include "program/ops.h"

namespace ombre::program {

using ValueId = uint32_t;

struct Instruction {
  Op op = Op::constant;
  ValueId a = 0, b = 0, c = 0;
  uint32_t aux = 0;  // index into maps, reads, calls or part sets
  double value = 0;  // the constant, or the number of an input or of a slot
};

template <class AnyInstruction, class F>
void each_operand(AnyInstruction& in, F f) {
  const int arity = info(in.op).arity;
  if (arity > 0) f(in.a);
  if (arity > 1) f(in.b);
  if (arity > 2) f(in.c);
}

struct Read {
  SourceField source;
  int channel = 0;
  uint32_t tag = 0;  // set and used by evaluators; passes keep it
};

struct Program;
struct PartSet;

struct Call {
  std::shared_ptr<const Program> body;
  uint32_t output = 0;
};

// A pure function from (x, y, z) to its outputs.
struct Program {
  std::vector<Instruction> code;
  std::vector<AffineRow> maps;
  std::vector<Read> reads;
  std::vector<Call> calls;
  std::vector<std::shared_ptr<const PartSet>> part_sets;  // see parts.h
  std::vector<ValueId> outputs;
  std::vector<std::string> output_names;  // one for each output; for printing

  bool has_calls() const { return !calls.empty(); }
  bool has_parts() const { return !part_sets.empty(); }
};

// Returns the range of a source over the ranges of its operands. By default the source itself computes it.
using SourceRanges = std::function<Interval(const Read&, const Box&)>;

// The evaluator whose rounded values an interval encloses: the double-precision reference or float batches.
enum class Precision : uint8_t { reference, batch };

}  // namespace ombre::program

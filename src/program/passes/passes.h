// Passes, which transform a program into an equivalent one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "program/program.h"

namespace ombre::program {

// Replaces every call by the code of its body.
Program inline_bodies(const Program& program);

class PartTable;

// A filter that removes parts that cannot reach a box, more precisely than the index, which knows only boxes.
class PartFilter {
 public:
  virtual ~PartFilter() = default;
  // Removes from `parts`, which are numbers in the table in ascending order, those that cannot reach the box.
  virtual void keep_reaching(const PartTable& table, const Box& where, std::vector<uint32_t>& parts) = 0;
};

// Replaces ops that stand for many parts by the code of the parts that reach a region. `values` are the ranges of the
// instructions in that region. Without a filter, parts are tested one by one.
Program expand_parts(const Program& program, const std::vector<Interval>& values, Precision precision,
                     PartFilter* filter = nullptr);

// Returns the largest number of parts that such an op stands for in the region, at most `most`.
size_t parts_in_reach(const Program& program, const std::vector<Interval>& values, size_t most);

// Returns the program for a region in which the instructions have the given ranges. Values that are constant there
// become constants; operands that cannot win a min, max or select are removed. If `kept` is given, it gets the ranges
// of the remaining instructions.
Program shorten(const Program& program, const std::vector<Interval>& values, std::vector<Interval>* kept = nullptr);

// Shortens a program for many regions and reuses memory between them.
class Shortener {
 public:
  // Sets the program, which must outlive all calls of shorten().
  void begin(const Program& program);
  void shorten(const std::vector<Interval>& values, Program& result, std::vector<Interval>& kept);

 private:
  ValueId settled(ValueId i) const;
  ValueId logical_target(ValueId i) const;
  bool is_at_most(ValueId less, ValueId greater, ValueId result) const;
  bool is_known(ValueId i) const;
  void find_needed();
  void copy_needed(Program& to, std::vector<Interval>& kept);

  const Program* from_ = nullptr;
  const std::vector<Interval>* values_ = nullptr;
  std::vector<uint8_t> zero_sign_matters_;  // empty until first needed
  std::vector<ValueId> target_, renamed_;
  std::vector<uint8_t> needed_;
};

// Replaces values that are only compared with zero by cheaper ones of the same sign. Sets and materials do not change,
// except for rounding at boundaries.
Program sign_only(const Program& program);

// Turns affine maps, and products that are only used in sums, into fused multiply-adds.
Program fuse(const Program& program);

// Versions that write to `result` and reuse memory between programs (replay.h).
struct Workspace;
void sign_only(const Program& program, Workspace& workspace, Program& result);
void fuse(const Program& program, Workspace& workspace, Program& result);

// Computes sums that are affine in the inputs directly from the inputs. Results are equal except for rounding, and
// their ranges are as narrow as possible.
Program compose_affine(const Program& program);

// Moves the instructions that output 0 needs to the front and returns their number.
size_t order_for_first(Program& program);

// Returns an upper bound of the number of instructions after inline_bodies, which may exceed memory by far.
double inlined_size(const Program& program);

// Returns the affine map from (x, y, z) to operands a, b, c of the instruction, or nothing if there is none. `base`
// holds three values that stand for x, y and z; by default these are the inputs.
std::optional<Affine> affine_operands(const Program& program, const Instruction& instruction,
                                      std::span<const ValueId> base = {});

}  // namespace ombre::program

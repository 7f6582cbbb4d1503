// Passes: program in, equal program out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "program/program.h"

namespace ombre::program {

// Replaces every call by the code of its body.
Program inline_bodies(const Program& program);

class PartTable;

// Drops parts that cannot reach a box, more sharply than their boxes in an index do.
class PartFilter {
 public:
  virtual ~PartFilter() = default;
  // Parts of the table, in ascending order.
  virtual void keep_reaching(const PartTable& table, const Box& where, std::vector<uint32_t>& parts) = 0;
};

// Replaces ops that stand for many parts by the code of those that reach a region, in which the
// instructions have the given values. Without a filter, parts are queried one by one.
Program expand_parts(const Program& program, const std::vector<Interval>& values, Precision precision,
                     PartFilter* filter = nullptr);

// How many parts such ops stand for in the region: of the op with the most of them, or `most`.
size_t parts_in_reach(const Program& program, const std::vector<Interval>& values, size_t most);

// The program for a region in which the instructions have the given values: what is settled there
// becomes a constant, what cannot win a min, max or select falls away.
// `kept`, if given, gets the values of the instructions that are left.
Program shorten(const Program& program, const std::vector<Interval>& values, std::vector<Interval>* kept = nullptr);

// The same for many regions, with allocations kept from one to the next.
class Shortener {
 public:
  // The program outlives the regions.
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
  std::vector<uint8_t> zero_sign_matters_;  // empty: not looked for yet
  std::vector<ValueId> target_, renamed_;
  std::vector<uint8_t> needed_;
};

// Where a distance is only compared with zero, compares what decides its sign. Sets and materials stay
// what they are but for rounding at boundaries.
Program sign_only(const Program& program);

// Affine maps become chains of fused multiply-adds, and so do products that are only added to something.
Program fuse(const Program& program);

// Both as above, with allocations kept from program to program (replay.h).
struct Workspace;
void sign_only(const Program& program, Workspace& workspace, Program& result);
void fuse(const Program& program, Workspace& workspace, Program& result);

// Sums that are affine in the inputs are computed from these at once, not from each other. Equal but for rounding; the
// ranges of such values are as narrow as can be.
Program compose_affine(const Program& program);

// Moves what output 0 needs to the front and returns how many instructions that is.
size_t order_for_first(Program& program);

// How many instructions inline_bodies would give, at most; may be far beyond what memory holds.
double inlined_size(const Program& program);

// The affine map that takes (x, y, z) to operands a, b, c of the given instruction, if there is one. `base`: three
// values that stand for x, y and z; by default the inputs.
std::optional<Affine> affine_operands(const Program& program, const Instruction& instruction,
                                      std::span<const ValueId> base = {});

}  // namespace ombre::program

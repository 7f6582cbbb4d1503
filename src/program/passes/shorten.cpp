// Removes instructions whose values are known in a region.
#include <algorithm>
#include <bit>

#include "program/passes/copy_tables.h"
#include "program/passes/passes.h"
#include "program/passes/zero_signs.h"

namespace ombre::program {
namespace {

bool is_same(const Instruction& a, const Instruction& b) {
  return a.op == b.op && a.a == b.a && a.b == b.b && a.c == b.c && a.aux == b.aux &&
         std::bit_cast<uint64_t>(a.value) == std::bit_cast<uint64_t>(b.value);
}

}  // namespace

void Shortener::begin(const Program& program) {
  from_ = &program;
  zero_sign_matters_.clear();
}

void Shortener::shorten(const std::vector<Interval>& values, Program& result, std::vector<Interval>& kept) {
  values_ = &values;
  if (zero_sign_matters_.empty()) zero_sign_matters_ = zero_signs_that_matter(*from_);
  find_needed();
  copy_needed(result, kept);
  result.outputs.clear();
  for (const ValueId output : from_->outputs) result.outputs.push_back(renamed_[target_[output]]);
  result.output_names = from_->output_names;
}

// Returns the operand that is sure to equal the instruction's value, or the instruction itself.
ValueId Shortener::settled(ValueId i) const {
  const Instruction& in = from_->code[i];
  const std::vector<Interval>& values = *values_;
  switch (in.op) {
    case Op::min:
      if (is_at_most(in.a, in.b, i)) return in.a;
      if (is_at_most(in.b, in.a, i)) return in.b;
      return i;
    case Op::max:
      if (is_at_most(in.b, in.a, i)) return in.a;
      if (is_at_most(in.a, in.b, i)) return in.b;
      return i;
    case Op::select:
      if (values[in.a].lo > 0 || values[in.a].hi < 0) return in.b;
      if (values[in.a] == Interval(0)) return in.c;
      return i;
    case Op::add: {
      // x + 0 is x, except that -0 + 0 is +0, so this is skipped where the sign of zero matters.
      const bool any_zero = zero_sign_matters_[i] == 0;
      if (values[in.a] == Interval(0) && (any_zero || lacks_zero(values[in.b]))) return in.b;
      if (values[in.b] == Interval(0) && (any_zero || lacks_zero(values[in.a]))) return in.a;
      return i;
    }
    case Op::multiply:
      if (values[in.a] == Interval(1)) return in.b;
      if (values[in.b] == Interval(1)) return in.a;
      return i;
    case Op::logical_or:
    case Op::logical_and:
      return logical_target(i);
    default:
      return i;
  }
}

// True if `less` is surely below `greater`, and neither is NaN. Equal values are allowed if the sign of the result's
// zeros does not matter.
bool Shortener::is_at_most(ValueId less, ValueId greater, ValueId result) const {
  const Interval a = (*values_)[less], b = (*values_)[greater];
  if (a.is_everything() || b.is_everything()) return false;
  return a.hi < b.lo || (a.hi == b.lo && zero_sign_matters_[result] == 0);
}

// Returns the other operand of an `or` whose one operand is surely false, or of an `and` whose one operand is surely
// true; else the instruction itself.
ValueId Shortener::logical_target(ValueId i) const {
  const Instruction& in = from_->code[i];
  const std::vector<Interval>& values = *values_;
  const double neutral = in.op == Op::logical_and ? 1 : 0;
  const auto is_neutral = [&](ValueId v) { return values[v] == Interval(neutral); };
  const auto is_truth = [&](ValueId v) {
    return values[v].lo >= 0 && values[v].hi <= 1 && gives_truth(from_->code[v].op);
  };
  if (is_neutral(in.a) && is_truth(in.b)) return in.b;
  if (is_neutral(in.b) && is_truth(in.a)) return in.a;
  return i;
}

// True if the value is replaced by a constant. Inputs never are, even in a region of a single point, since other code
// looks for them. Zeros are only if their sign does not matter, which intervals do not know.
bool Shortener::is_known(ValueId i) const {
  const Op op = from_->code[i].op;
  const Interval value = (*values_)[i];
  if (op == Op::input || !value.is_point() || !std::isfinite(value.lo)) return false;
  return op == Op::constant || value.lo != 0 || zero_sign_matters_[i] == 0;
}

void Shortener::find_needed() {
  const size_t n = from_->code.size();
  target_.resize(n);
  needed_.assign(n, 0);
  for (ValueId i = 0; i < n; ++i) {
    const ValueId next = is_known(i) ? i : settled(i);
    target_[i] = next == i ? i : target_[next];
  }
  for (const ValueId output : from_->outputs) needed_[target_[output]] = 1;
  for (size_t i = n; i-- > 0;) {
    if (needed_[i] == 0 || is_known(static_cast<ValueId>(i))) continue;
    each_operand(from_->code[i], [&](ValueId id) { needed_[target_[id]] = 1; });
  }
}

void Shortener::copy_needed(Program& to, std::vector<Interval>& kept) {
  const size_t n = from_->code.size();
  renamed_.resize(n);
  to.code.clear();
  to.maps.clear();
  to.reads.clear();
  to.calls.clear();
  to.part_sets.clear();
  kept.clear();
  const auto count = static_cast<size_t>(std::count(needed_.begin(), needed_.end(), 1));
  to.code.reserve(count);
  kept.reserve(count);
  for (ValueId i = 0; i < n; ++i) {
    if (needed_[i] == 0) continue;
    Instruction in = from_->code[i];
    if (is_known(i)) {
      in = Instruction{};
      in.value = (*values_)[i].lo;
    } else {
      each_operand(in, [&](ValueId& id) { id = renamed_[target_[id]]; });
      copy_tables(*from_, to, in);
    }
    // Copies of parts that are absent in the region become identical, and follow each other.
    const bool is_repeated = !to.code.empty() && is_same(in, to.code.back());
    if (!is_repeated) {
      to.code.push_back(in);
      kept.push_back((*values_)[i]);
    }
    renamed_[i] = static_cast<ValueId>(to.code.size() - 1);
  }
}

Program shorten(const Program& program, const std::vector<Interval>& values, std::vector<Interval>* kept) {
  Shortener shortener;
  shortener.begin(program);
  Program result;
  std::vector<Interval> left;
  shortener.shorten(values, result, left);
  if (kept) *kept = std::move(left);
  return result;
}

}  // namespace ombre::program

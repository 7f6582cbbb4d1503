// Drops what a region has settled.
#include <algorithm>

#include "program/passes/copy_tables.h"
#include "program/passes/passes.h"
#include "program/passes/zero_signs.h"

namespace ombre::program {
namespace {

bool lacks_zero(Interval v) { return v.lo > 0 || v.hi < 0; }

// The operand that an instruction is sure to equal, or the instruction itself.
ValueId settled(const Program& program, ValueId i, const std::vector<Interval>& values, bool zero_sign_matters) {
  const Instruction& in = program.code[i];
  const auto never_nan = [&](ValueId v) { return !values[v].is_everything(); };
  switch (in.op) {
    case Op::min:
      if (never_nan(in.a) && never_nan(in.b)) {
        if (values[in.a].hi < values[in.b].lo) return in.a;
        if (values[in.b].hi < values[in.a].lo) return in.b;
      }
      return i;
    case Op::max:
      if (never_nan(in.a) && never_nan(in.b)) {
        if (values[in.a].lo > values[in.b].hi) return in.a;
        if (values[in.b].lo > values[in.a].hi) return in.b;
      }
      return i;
    case Op::select:
      if (values[in.a].lo > 0 || values[in.a].hi < 0) return in.b;
      if (values[in.a] == Interval(0)) return in.c;
      return i;
    case Op::add:
      // Zeros aside, whose sign a sum may change.
      if (values[in.a] == Interval(0) && (!zero_sign_matters || lacks_zero(values[in.b]))) return in.b;
      if (values[in.b] == Interval(0) && (!zero_sign_matters || lacks_zero(values[in.a]))) return in.a;
      return i;
    case Op::multiply:
      if (values[in.a] == Interval(1)) return in.b;
      if (values[in.b] == Interval(1)) return in.a;
      return i;
    default:
      return i;
  }
}

class Shortener {
 public:
  Shortener(const Program& program, const std::vector<Interval>& values, std::vector<Interval>* kept)
      : from_(program), values_(values), kept_(kept), zero_sign_matters_(zero_signs_that_matter(program)) {
    if (kept_) kept_->clear();
  }

  Program run() {
    find_needed();
    copy_needed();
    for (const ValueId output : from_.outputs) to_.outputs.push_back(renamed_[target_[output]]);
    to_.output_names = from_.output_names;
    return std::move(to_);
  }

 private:
  // Inputs stay what they are, also where the region is one point wide: others look for them. Intervals do not
  // know the sign of a 0.
  bool is_known(ValueId i) const {
    const Op op = from_.code[i].op;
    if (op == Op::input || !values_[i].is_point() || !std::isfinite(values_[i].lo)) return false;
    return op == Op::constant || values_[i].lo != 0 || !zero_sign_matters_[i];
  }

  // An `or` with a side that is surely false is its other side, and the like.
  ValueId logical_target(ValueId i) const {
    const Instruction& in = from_.code[i];
    if (in.op != Op::logical_or && in.op != Op::logical_and) return i;
    const double neutral = in.op == Op::logical_and ? 1 : 0;
    const auto is_neutral = [&](ValueId v) { return values_[v] == Interval(neutral); };
    const auto is_truth = [&](ValueId v) {
      return values_[v].lo >= 0 && values_[v].hi <= 1 && gives_truth(from_.code[v].op);
    };
    if (is_neutral(in.a) && is_truth(in.b)) return in.b;
    if (is_neutral(in.b) && is_truth(in.a)) return in.a;
    return i;
  }

  void find_needed() {
    const size_t n = from_.code.size();
    target_.resize(n);
    needed_.assign(n, false);
    for (ValueId i = 0; i < n; ++i) {
      const ValueId next = is_known(i) ? i : logical_target(settled(from_, i, values_, zero_sign_matters_[i]));
      target_[i] = next == i ? i : target_[next];
    }
    for (const ValueId output : from_.outputs) needed_[target_[output]] = true;
    for (size_t i = n; i-- > 0;) {
      if (!needed_[i] || is_known(static_cast<ValueId>(i))) continue;
      const Instruction& in = from_.code[i];
      const int arity = info(in.op).arity;
      if (arity > 0) needed_[target_[in.a]] = true;
      if (arity > 1) needed_[target_[in.b]] = true;
      if (arity > 2) needed_[target_[in.c]] = true;
    }
  }

  void copy_needed() {
    renamed_.assign(from_.code.size(), 0);
    const auto count = static_cast<size_t>(std::count(needed_.begin(), needed_.end(), true));
    to_.code.reserve(count);
    if (kept_) kept_->reserve(count);
    for (ValueId i = 0; i < from_.code.size(); ++i) {
      if (!needed_[i]) continue;
      Instruction in = from_.code[i];
      if (is_known(i)) {
        in = Instruction{};
        in.value = values_[i].lo;
      } else {
        in.a = renamed_[target_[in.a]];
        in.b = renamed_[target_[in.b]];
        in.c = renamed_[target_[in.c]];
        copy_tables(from_, to_, in);
      }
      renamed_[i] = static_cast<ValueId>(to_.code.size());
      to_.code.push_back(in);
      if (kept_) kept_->push_back(values_[i]);
    }
  }

  const Program& from_;
  const std::vector<Interval>& values_;
  std::vector<Interval>* kept_;
  Program to_;
  std::vector<bool> zero_sign_matters_;
  std::vector<ValueId> target_, renamed_;
  std::vector<bool> needed_;
};

}  // namespace

Program shorten(const Program& program, const std::vector<Interval>& values, std::vector<Interval>* kept) {
  return Shortener(program, values, kept).run();
}

}  // namespace ombre::program

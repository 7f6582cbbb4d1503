// Removes the computation of values that are only compared with zero.
#include <algorithm>

#include "program/passes/passes.h"
#include "program/passes/replay.h"

namespace ombre::program {
namespace {

class SignOnly {
 public:
  SignOnly(const Program& program, Builder& builder) : program_(program), builder_(builder) {}

  std::optional<Field> rewrite(ValueId id, const std::vector<Field>& done) {
    const Instruction& in = program_.code[id];
    const bool compares = in.op == Op::less_equal || in.op == Op::less;
    if (!compares || !is_constant(in.b, 0)) return std::nullopt;
    compare_ = in.op;
    done_ = &done;
    return negative(in.a);
  }

 private:
  const Instruction& at(ValueId id) const { return program_.code[id]; }
  bool is(ValueId id, Op op) const { return at(id).op == op; }
  bool is_constant(ValueId id) const { return is(id, Op::constant); }
  bool is_constant(ValueId id, double value) const { return is_constant(id) && at(id).value == value; }

  Field compared(ValueId id, double limit) const {
    return builder_.apply(compare_, (*done_)[id], builder_.constant(limit));
  }

  // Returns the truth value of v <= 0, or of v < 0.
  Field negative(ValueId id) const {
    const Instruction& in = at(id);
    if (in.op == Op::max) return logical_and(negative(in.a), negative(in.b));
    if (in.op == Op::min) return logical_or(negative(in.a), negative(in.b));
    if (in.op == Op::subtract && is_constant(in.b) && std::isfinite(at(in.b).value)) return below(in.a, at(in.b).value);
    if (in.op == Op::multiply && is_constant(in.a) && at(in.a).value > 0) return negative(in.b);
    if (in.op == Op::multiply && is_constant(in.b) && at(in.b).value > 0) return negative(in.a);
    if (const auto sides = corner(in)) {
      Field all = negative((*sides)[0]);
      for (size_t i = 1; i < sides->size(); ++i) all = logical_and(all, negative((*sides)[i]));
      return all;
    }
    return compared(id, 0);
  }

  // Replaces sqrt(s) <= r by s <= r^2.
  Field below(ValueId id, double limit) const {
    if (is(id, Op::sqrt) && limit >= 0) return compared(at(id).a, limit * limit);
    return compared(id, limit);
  }

  // Returns the operands a, b, ... of length(max(a, 0), max(b, 0), ...) + min(max(a, b, ...), 0). The sum is positive
  // if one of them is.
  std::optional<std::vector<ValueId>> corner(const Instruction& in) const {
    if (in.op != Op::add || !is(in.a, Op::sqrt) || !is(in.b, Op::min) || !is_constant(at(in.b).b, 0))
      return std::nullopt;
    std::vector<ValueId> outside, within;
    if (!collect_squares(at(in.a).a, outside)) return std::nullopt;
    collect_greatest(at(in.b).a, outside.size(), within);
    std::sort(outside.begin(), outside.end());
    std::sort(within.begin(), within.end());
    if (outside != within) return std::nullopt;
    return outside;
  }

  bool collect_squares(ValueId id, std::vector<ValueId>& sides) const {
    const Instruction& in = at(id);
    if (in.op == Op::add) return collect_squares(in.a, sides) && collect_squares(in.b, sides);
    if (in.op != Op::square || !is(in.a, Op::max) || !is_constant(at(in.a).b, 0)) return false;
    sides.push_back(at(in.a).a);
    return true;
  }

  void collect_greatest(ValueId id, size_t most, std::vector<ValueId>& sides) const {
    if (is(id, Op::max) && sides.size() + 1 < most) {
      collect_greatest(at(id).a, most - 1, sides);
      sides.push_back(at(id).b);
    } else {
      sides.push_back(id);
    }
  }

  const Program& program_;
  Builder& builder_;
  Op compare_ = Op::less_equal;
  const std::vector<Field>* done_ = nullptr;
};

}  // namespace

Program sign_only(const Program& program) { return rewritten_by<SignOnly>(program); }

void sign_only(const Program& program, Workspace& workspace, Program& result) {
  rewrite_by<SignOnly>(program, workspace, result);
}

}  // namespace ombre::program

// Computes values that are affine in the inputs directly from the inputs.
//
// Nested rotations would otherwise compute ranges of coordinates from ranges of x, y and z as if these were
// independent, and ranges would grow at each step.
#include <algorithm>
#include <cmath>

#include "program/passes/affine_form.h"
#include "program/passes/copy_tables.h"
#include "program/passes/passes.h"

namespace ombre::program {
namespace {

class Composer {
 public:
  explicit Composer(const Program& program) : from_(program) {}

  Program run() {
    find_forms();
    find_needed();
    for (const Instruction& in : from_.code)
      if (in.op == Op::input) input(static_cast<size_t>(in.value));
    for (ValueId id = 0; id < from_.code.size(); ++id) {
      if (is_needed_[id] != 0) renamed_[id] = is_composed_[id] != 0 ? chain(*forms_[id]) : copy(id);
    }
    for (const ValueId output : from_.outputs) to_.outputs.push_back(renamed_[output]);
    to_.output_names = from_.output_names;
    return std::move(to_);
  }

 private:
  void find_forms() {
    forms_.reserve(from_.code.size());
    const auto form_of = [&](ValueId id) { return forms_[id]; };
    const auto is_finite = [](double f) { return std::isfinite(f); };
    for (const Instruction& in : from_.code) {
      forms_.push_back(affine_form(from_, in, form_of));
      if (forms_.back() && !std::all_of(forms_.back()->begin(), forms_.back()->end(), is_finite)) forms_.back().reset();
    }
  }

  // True for an affine value of two different operands, neither of them constant. A value of one operand has a range
  // that is already as narrow as possible.
  bool is_sum(ValueId id) const {
    if (!forms_[id]) return false;
    ValueId one = none;
    bool has_two = false;
    each_operand(from_.code[id], [&](ValueId operand) {
      if (is_constant(*forms_[operand]) || operand == one) return;
      has_two |= one != none;
      one = operand;
    });
    return has_two;
  }

  // Marks needed values, starting from the outputs. The search ends at composed values, which need only inputs.
  void find_needed() {
    is_needed_.assign(from_.code.size(), 0);
    is_composed_.assign(from_.code.size(), 0);
    renamed_.resize(from_.code.size());
    for (const ValueId output : from_.outputs) is_needed_[output] = 1;
    for (size_t n = from_.code.size(); n-- > 0;) {
      if (is_needed_[n] == 0) continue;
      is_composed_[n] = is_sum(static_cast<ValueId>(n)) ? 1 : 0;
      if (is_composed_[n] != 0) continue;
      each_operand(from_.code[n], [&](ValueId id) { is_needed_[id] = 1; });
    }
  }

  ValueId push(const Instruction& in) {
    to_.code.push_back(in);
    return static_cast<ValueId>(to_.code.size() - 1);
  }

  ValueId copy(ValueId id) {
    Instruction in = from_.code[id];
    if (in.op == Op::input) return input(static_cast<size_t>(in.value));
    each_operand(in, [&](ValueId& operand) { operand = renamed_[operand]; });
    copy_tables(from_, to_, in);
    return push(in);
  }

  ValueId input(size_t axis) {
    if (inputs_[axis] == none) {
      Instruction in;
      in.op = Op::input;
      in.value = static_cast<double>(axis);
      inputs_[axis] = push(in);
    }
    return inputs_[axis];
  }

  ValueId constant(double value) {
    Instruction in;
    in.value = value;
    return push(in);
  }

  // Adds z before y before x, so that what changes least often is computed first.
  ValueId chain(const AffineRow& form) {
    ValueId sum = none;
    if (form[3] != 0) sum = constant(form[3]);
    for (const size_t axis : {size_t{2}, size_t{1}, size_t{0}}) {
      if (form[axis] == 0) continue;
      Instruction in;
      in.a = constant(form[axis]);
      in.b = input(axis);
      in.op = sum == none ? Op::multiply : Op::fma;
      if (sum != none) in.c = sum;
      sum = push(in);
    }
    return sum == none ? constant(0) : sum;
  }

  static constexpr ValueId none = ~ValueId{0};
  const Program& from_;
  Program to_;
  std::vector<std::optional<AffineRow>> forms_;
  std::vector<uint8_t> is_needed_, is_composed_;
  std::vector<ValueId> renamed_;
  std::array<ValueId, 3> inputs_{none, none, none};
};

}  // namespace

Program compose_affine(const Program& program) { return Composer(program).run(); }

}  // namespace ombre::program

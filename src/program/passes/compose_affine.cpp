// Values that are affine in the inputs are computed from the inputs at once.
//
// A turned frame within a turned view would be asked for the ranges of its coordinates through those of x, y and z, as
// if these knew nothing of each other.
#include <algorithm>
#include <cmath>

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
    for (ValueId id = 0; id < from_.code.size(); ++id) {
      if (is_needed_[id] != 0) renamed_[id] = is_composed_[id] != 0 ? chain(forms_[id]) : copy(id);
    }
    for (const ValueId output : from_.outputs) to_.outputs.push_back(renamed_[output]);
    to_.output_names = from_.output_names;
    return std::move(to_);
  }

 private:
  enum class Kind : uint8_t { other, constant, scaled, sum };  // scaled: of one value, which may be an input

  void find_forms() {
    forms_.resize(from_.code.size());
    kinds_.assign(from_.code.size(), Kind::other);
    for (ValueId id = 0; id < from_.code.size(); ++id) find_form(id);
  }

  void find_form(ValueId id) {
    const Instruction& in = from_.code[id];
    AffineRow& form = forms_[id];
    switch (in.op) {
      case Op::input:
        form[static_cast<size_t>(in.value)] = 1;
        kinds_[id] = Kind::scaled;
        return;
      case Op::constant:
        form[3] = in.value;
        if (std::isfinite(in.value)) kinds_[id] = Kind::constant;
        return;
      case Op::negate:
        return add(id, in.a, -1, in.a, 0);
      case Op::add:
        return add(id, in.a, 1, in.b, 1);
      case Op::subtract:
        return add(id, in.a, 1, in.b, -1);
      case Op::multiply:
        if (is_constant(in.a)) return add(id, in.b, forms_[in.a][3], in.b, 0);
        if (is_constant(in.b)) return add(id, in.a, forms_[in.b][3], in.a, 0);
        return;
      case Op::fma:
        if (is_constant(in.a)) return add(id, in.b, forms_[in.a][3], in.c, 1);
        if (is_constant(in.b)) return add(id, in.a, forms_[in.b][3], in.c, 1);
        return;
      default:
        return;
    }
  }

  bool is_constant(ValueId id) const { return kinds_[id] == Kind::constant; }

  void add(ValueId id, ValueId a, double factor_a, ValueId b, double factor_b) {
    if (kinds_[a] == Kind::other || kinds_[b] == Kind::other) return;
    for (size_t n = 0; n < 4; ++n) forms_[id][n] = factor_a * forms_[a][n] + factor_b * forms_[b][n];
    if (!std::all_of(forms_[id].begin(), forms_[id].end(), [](double f) { return std::isfinite(f); })) return;
    const bool is_one = a == b || is_constant(a) || is_constant(b);
    kinds_[id] = is_constant(a) && is_constant(b) ? Kind::constant : is_one ? Kind::scaled : Kind::sum;
  }

  // From the outputs on, through composed values to nothing: they need inputs alone.
  void find_needed() {
    is_needed_.assign(from_.code.size(), 0);
    is_composed_.assign(from_.code.size(), 0);
    renamed_.resize(from_.code.size());
    for (const ValueId output : from_.outputs) is_needed_[output] = 1;
    for (size_t n = from_.code.size(); n-- > 0;) {
      if (is_needed_[n] == 0) continue;
      is_composed_[n] = kinds_[n] == Kind::sum ? 1 : 0;
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

  // What changes least often comes first.
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
  std::vector<AffineRow> forms_;  // factors of the inputs and a summand, where the kind is not `other`
  std::vector<Kind> kinds_;
  std::vector<uint8_t> is_needed_, is_composed_;
  std::vector<ValueId> renamed_;
  std::array<ValueId, 3> inputs_{none, none, none};
};

}  // namespace

Program compose_affine(const Program& program) { return Composer(program).run(); }

}  // namespace ombre::program

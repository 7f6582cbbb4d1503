#include "program/gradient.h"

#include <cmath>
#include <numbers>
#include <unordered_map>

namespace ombre::program {
namespace {

// A field without a builder stands for 0.
Field sum_of(Field a, Field b) { return !a ? b : !b ? a : a + b; }
Field difference_of(Field a, Field b) { return !b ? a : !a ? -b : a - b; }
Field scaled(Field a, Field factor) { return a ? a * factor : a; }
Field scaled(Field a, double factor) { return a ? a * factor : a; }
Field divided(Field a, Field by) { return a ? a / by : a; }

class Differentiator {
 public:
  Differentiator(Builder& builder, const Point& at) : builder_(builder) {
    const Field coordinates[] = {at.x, at.y, at.z};
    for (size_t axis = 0; axis < 3; ++axis) known_[coordinates[axis].id][axis] = builder.constant(1);
    for (const Field index : at.cell)
      if (index) known_.try_emplace(index.id);
  }

  std::optional<std::array<Field, 3>> run(Field of) {
    if (!visit(of.id)) return std::nullopt;
    std::array<Field, 3> result = known_[of.id];
    for (Field& part : result)
      if (!part) part = builder_.constant(0);
    return result;
  }

 private:
  using Slopes = std::array<Field, 3>;
  // Visits operands first, without recursion, since formulas may be deep.
  bool visit(ValueId root) {
    std::vector<ValueId> open{root};
    while (!open.empty()) {
      const ValueId id = open.back();
      if (known_.contains(id)) {
        open.pop_back();
        continue;
      }
      const Instruction in = builder_.instruction({&builder_, id});
      const size_t before = open.size();
      each_operand(in, [&](ValueId operand) {
        if (!known_.contains(operand)) open.push_back(operand);
      });
      if (open.size() > before) continue;
      if (!derive(id, in)) return false;
      open.pop_back();
    }
    return true;
  }

  Field field(ValueId id) const { return {&builder_, id}; }
  Field apply(Op op, Field a) const { return builder_.apply(op, a); }
  Field where_positive(Field condition, Field value) const {
    return value ? select(less(builder_.constant(0), condition), value, builder_.constant(0)) : value;
  }
  Field chosen(Field condition, Field a, Field b) const {
    if (!a && !b) return a;
    const Field zero = builder_.constant(0);
    return select(condition, a ? a : zero, b ? b : zero);
  }

  bool derive(ValueId id, const Instruction& in) {
    Slopes slopes;
    for (size_t axis = 0; axis < 3; ++axis) {
      const int arity = info(in.op).arity;
      const auto slope = [&](ValueId operand) { return known_.at(operand)[axis]; };
      const Field da = arity > 0 ? slope(in.a) : Field{}, db = arity > 1 ? slope(in.b) : Field{},
                  dc = arity > 2 ? slope(in.c) : Field{};
      const auto made = slope_of(in, field(id), da, db, dc);
      if (!made) return false;
      slopes[axis] = *made;
    }
    known_[id] = slopes;
    return true;
  }

  std::optional<Field> slope_of(const Instruction& in, Field result, Field da, Field db, Field dc) const {
    const Field a = field(in.a), b = field(in.b);
    const auto of_a = [&](auto factor) { return da ? scaled(da, factor()) : da; };
    switch (in.op) {
      case Op::constant:
      case Op::floor:
      case Op::ceil:
      case Op::round:
      case Op::trunc:
        return Field{};
      case Op::affine: {
        const AffineRow m = builder_.affine_row(result);
        return sum_of(sum_of(scaled(da, m[0]), scaled(db, m[1])), scaled(dc, m[2]));
      }
      case Op::add:
        return sum_of(da, db);
      case Op::subtract:
        return difference_of(da, db);
      case Op::multiply:
        return sum_of(scaled(da, b), scaled(db, a));
      case Op::divide:
        return divided(difference_of(da, scaled(db, result)), b);
      case Op::fma:
        return sum_of(sum_of(scaled(da, b), scaled(db, a)), dc);
      case Op::negate:
        return da ? -da : da;
      case Op::min:
        return chosen(less_equal(a, b), da, db);
      case Op::max:
        return chosen(less_equal(b, a), da, db);
      case Op::abs:
        return chosen(less(a, builder_.constant(0)), da ? -da : da, da);
      case Op::select:
        return chosen(a, db, dc);
      case Op::sqrt:
        return where_positive(result, divided(da, result * 2.0));
      case Op::square:
        return of_a([&] { return a * 2.0; });
      case Op::mod:
        return db ? std::nullopt : std::optional(da);
      case Op::pow:
        if (db || !builder_.constant_value(b)) return std::nullopt;
        return of_a([&] { return power(a, builder_.constant(*builder_.constant_value(b) - 1)) * b; });
      case Op::sin:
        return of_a([&] { return apply(Op::cos, a); });
      case Op::cos:
        return of_a([&] { return -apply(Op::sin, a); });
      case Op::tan:
        return of_a([&] { return square(result) + 1; });
      case Op::asin:
        return divided(da, sqrt(1 - square(a)));
      case Op::acos:
        return divided(scaled(da, -1.0), sqrt(1 - square(a)));
      case Op::atan:
        return divided(da, square(a) + 1);
      case Op::atan2: {
        const Field squared = square(a) + square(b);
        return where_positive(squared, divided(difference_of(scaled(da, b), scaled(db, a)), squared));
      }
      case Op::sinh:
        return of_a([&] { return apply(Op::cosh, a); });
      case Op::cosh:
        return of_a([&] { return apply(Op::sinh, a); });
      case Op::tanh:
        return of_a([&] { return 1 - square(result); });
      case Op::exp:
        return of_a([&] { return result; });
      case Op::log:
        return divided(da, a);
      case Op::log10:
        return divided(da, a * std::numbers::ln10);
      case Op::log2:
        return divided(da, a * std::numbers::ln2);
      default:
        return gives_truth(in.op) ? std::optional(Field{}) : std::nullopt;
    }
  }

  Builder& builder_;
  std::unordered_map<ValueId, Slopes> known_;
};

}  // namespace

std::optional<std::array<Field, 3>> gradient(Field of, const Point& at) {
  return Differentiator(*of.builder, at).run(of);
}

}  // namespace ombre::program

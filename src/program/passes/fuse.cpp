// Fuses multiplications followed by additions into one op that rounds once.
//
// A product that depends on fewer axes than the sum is not fused, since it can be computed once for many sums.
#include <algorithm>

#include "program/passes/passes.h"
#include "program/passes/replay.h"

namespace ombre::program {
namespace {

class Fuser {
 public:
  Fuser(const Program& program, Builder& builder) : program_(program), builder_(builder), masks_(axis_masks(program)) {
    uses_.assign(program.code.size(), 0);
    for (const Instruction& in : program.code) {
      const int arity = info(in.op).arity;
      if (arity > 0) ++uses_[in.a];
      if (arity > 1) ++uses_[in.b];
      if (arity > 2) ++uses_[in.c];
    }
    for (const ValueId output : program.outputs) ++uses_[output];
  }

  std::optional<Field> rewrite(ValueId id, const std::vector<Field>& done) {
    const Instruction& in = program_.code[id];
    if (in.op == Op::affine) return chain(in, done);
    if (in.op != Op::add) return std::nullopt;
    if (can_fuse(in.a, id)) return fused(in.a, in.b, done);
    if (can_fuse(in.b, id)) return fused(in.b, in.a, done);
    return std::nullopt;
  }

 private:
  bool can_fuse(ValueId product, ValueId sum) const {
    const Op op = program_.code[product].op;
    return (op == Op::multiply || op == Op::square) && uses_[product] == 1 && masks_[product] == masks_[sum];
  }

  Field fused(ValueId product, ValueId rest, const std::vector<Field>& done) {
    const Instruction& in = program_.code[product];
    const Field a = done[in.a], b = in.op == Op::square ? a : done[in.b];
    return builder_.apply(Op::fma, a, b, done[rest]);
  }

  // Orders terms so that what changes least often is summed first and partial sums are shared by rows and layers.
  Field chain(const Instruction& in, const std::vector<Field>& done) {
    const AffineRow& row = program_.maps[in.aux];
    std::array<std::pair<ValueId, double>, 3> terms{{{in.a, row[0]}, {in.b, row[1]}, {in.c, row[2]}}};
    const auto cost = [&](ValueId id) { return (masks_[id] & 1 ? 8 : 0) + masks_[id]; };
    std::stable_sort(terms.begin(), terms.end(),
                     [&](const auto& a, const auto& b) { return cost(a.first) < cost(b.first); });
    Field sum = builder_.constant(row[3]);
    bool is_empty = row[3] == 0;
    for (const auto& [id, factor] : terms) {
      if (factor == 0) continue;
      const Field f = builder_.constant(factor);
      sum = is_empty ? builder_.apply(Op::multiply, f, done[id]) : builder_.apply(Op::fma, f, done[id], sum);
      is_empty = false;
    }
    return sum;
  }

  const Program& program_;
  Builder& builder_;
  std::vector<uint8_t> masks_;
  std::vector<uint32_t> uses_;
};

}  // namespace

Program fuse(const Program& program) { return rewritten_by<Fuser>(program); }

void fuse(const Program& program, Workspace& workspace, Program& result) {
  rewrite_by<Fuser>(program, workspace, result);
}

}  // namespace ombre::program

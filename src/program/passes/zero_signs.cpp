#include "program/passes/zero_signs.h"

namespace ombre::program {
namespace {

// True if the results for +0 and -0 are equal.
bool forgets_sign(Op op) {
  return gives_truth(op) || op == Op::abs || op == Op::square || op == Op::cos || op == Op::cosh || op == Op::exp;
}

}  // namespace

std::vector<uint8_t> zero_signs_that_matter(const Program& program) {
  std::vector<uint8_t> matters(program.code.size(), false);
  const auto may_be_zero = [&](ValueId id) {
    return program.code[id].op != Op::constant || program.code[id].value == 0;
  };
  for (size_t i = program.code.size(); i-- > 0;) {
    const Instruction& in = program.code[i];
    const int arity = info(in.op).arity;
    switch (in.op) {
      case Op::divide:
        if (may_be_zero(in.b)) matters[in.b] = true;
        break;
      case Op::pow:
        matters[in.a] = true;
        break;
      case Op::atan2:
      case Op::source:
      case Op::parts:
      case Op::call:
        matters[in.a] = matters[in.b] = true;
        if (arity > 2) matters[in.c] = true;
        break;
      default:
        break;
    }
    if (!matters[i] || forgets_sign(in.op)) continue;
    if (arity > 0 && in.op != Op::select) matters[in.a] = true;
    if (arity > 1) matters[in.b] = true;
    if (arity > 2) matters[in.c] = true;
  }
  return matters;
}

}  // namespace ombre::program

// Moves the instructions that the first output needs to the front.
#include "program/passes/copy_tables.h"
#include "program/passes/passes.h"

namespace ombre::program {

size_t order_for_first(Program& program) {
  const size_t n = program.code.size();
  std::vector<bool> early(n, false);
  early[program.outputs[0]] = true;
  for (size_t i = n; i-- > 0;) {
    if (!early[i]) continue;
    const Instruction& in = program.code[i];
    const int arity = info(in.op).arity;
    if (arity > 0) early[in.a] = true;
    if (arity > 1) early[in.b] = true;
    if (arity > 2) early[in.c] = true;
  }
  Program result;
  std::vector<ValueId> renamed(n, 0);
  size_t early_count = 0;
  for (const bool now : {true, false}) {
    for (size_t i = 0; i < n; ++i) {
      if (early[i] != now) continue;
      Instruction in = program.code[i];
      in.a = renamed[in.a];
      in.b = renamed[in.b];
      in.c = renamed[in.c];
      copy_tables(program, result, in);
      renamed[i] = static_cast<ValueId>(result.code.size());
      result.code.push_back(in);
    }
    if (now) early_count = result.code.size();
  }
  for (const ValueId output : program.outputs) result.outputs.push_back(renamed[output]);
  result.output_names = program.output_names;
  program = std::move(result);
  return early_count;
}

}  // namespace ombre::program

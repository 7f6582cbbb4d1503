#include "program/passes/replay.h"

#include "base/system/assert.h"

namespace ombre::program {
namespace {

Field copy(Builder& builder, const Program& program, const Instruction& in, const std::array<Field, 3>& inputs,
           const std::vector<Field>& done) {
  const auto at = [&](ValueId id) { return done[id]; };
  switch (in.op) {
    case Op::input:
      return inputs[static_cast<size_t>(in.value)];
    case Op::constant:
      return builder.constant(in.value);
    case Op::affine:
      return builder.affine(program.maps[in.aux], at(in.a), at(in.b), at(in.c));
    case Op::source: {
      const Read& read = program.reads[in.aux];
      return builder.source(read.source, read.channel, at(in.a), at(in.b), at(in.c), read.tag);
    }
    case Op::parts:
      return builder.parts(program.part_sets[in.aux], static_cast<size_t>(in.value), at(in.a), at(in.b), at(in.c));
    case Op::call:
      ASSERT(false && "calls are inlined before");
      return {};
    default: {
      const int arity = info(in.op).arity;
      return builder.apply(in.op, at(in.a), arity > 1 ? at(in.b) : Field{}, arity > 2 ? at(in.c) : Field{});
    }
  }
}

}  // namespace

namespace {

void replay_into(std::vector<Field>& done, Builder& builder, const Program& program, const std::array<Field, 3>& inputs,
                 const Rewrite& rewrite) {
  done.clear();
  done.reserve(program.code.size());
  for (ValueId id = 0; id < program.code.size(); ++id) {
    const auto changed = rewrite ? rewrite(id, done) : std::nullopt;
    done.push_back(changed ? *changed : copy(builder, program, program.code[id], inputs, done));
  }
}

}  // namespace

std::vector<Field> replay(Builder& builder, const Program& program, const std::array<Field, 3>& inputs,
                          const Rewrite& rewrite) {
  std::vector<Field> done;
  replay_into(done, builder, program, inputs, rewrite);
  return done;
}

void rewrite(const Program& program, Workspace& workspace, const Rewrite& rewrite, Program& result) {
  auto& [builder, fields, outputs] = workspace;
  replay_into(fields, builder, program, {builder.input(0), builder.input(1), builder.input(2)}, rewrite);
  outputs.clear();
  for (size_t n = 0; n < program.outputs.size(); ++n)
    outputs.emplace_back(program.output_names[n], fields[program.outputs[n]]);
  builder.finish(outputs, result);
}

std::vector<uint8_t> axis_masks(const Program& program) {
  std::vector<uint8_t> masks(program.code.size(), 0);
  for (size_t i = 0; i < program.code.size(); ++i) {
    const Instruction& in = program.code[i];
    const int arity = info(in.op).arity;
    if (in.op == Op::input) masks[i] = static_cast<uint8_t>(1 << static_cast<int>(in.value));
    if (arity > 0) masks[i] |= masks[in.a];
    if (arity > 1) masks[i] |= masks[in.b];
    if (arity > 2) masks[i] |= masks[in.c];
  }
  return masks;
}

}  // namespace ombre::program

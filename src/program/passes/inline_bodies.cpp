// Bodies are written where they are called. Equal calls share one copy.
#include <map>

#include "program/field.h"
#include "program/passes/passes.h"

namespace ombre::program {
namespace {

using Arguments = std::array<ValueId, 3>;

class Inliner {
 public:
  explicit Inliner(Builder& builder) : builder_(builder) {}

  // The fields of all of a program's instructions at the given inputs; each body and place only once.
  const std::vector<Field>& expand(const Program& program, const Arguments& inputs) {
    auto [it, is_new] = done_.try_emplace({&program, inputs});
    if (!is_new) return it->second;
    std::vector<Field> fields;
    fields.reserve(program.code.size());
    for (const Instruction& in : program.code) fields.push_back(translate(program, in, fields, inputs));
    return done_[{&program, inputs}] = std::move(fields);
  }

 private:
  Field translate(const Program& program, const Instruction& in, const std::vector<Field>& fields,
                  const Arguments& inputs) {
    const auto at = [&](ValueId id) { return fields[id]; };
    switch (in.op) {
      case Op::input:
        return {&builder_, inputs[static_cast<size_t>(in.value)]};
      case Op::constant:
        return builder_.constant(in.value);
      case Op::affine:
        return builder_.affine(program.maps[in.aux], at(in.a), at(in.b), at(in.c));
      case Op::source: {
        const Read& read = program.reads[in.aux];
        return builder_.source(read.source, read.channel, at(in.a), at(in.b), at(in.c));
      }
      case Op::call: {
        const Call& call = program.calls[in.aux];
        const auto& body = expand(*call.body, {at(in.a).id, at(in.b).id, at(in.c).id});
        return body[call.body->outputs[call.output]];
      }
      default: {
        const int arity = info(in.op).arity;
        return builder_.apply(in.op, at(in.a), arity > 1 ? at(in.b) : Field{}, arity > 2 ? at(in.c) : Field{});
      }
    }
  }

  Builder& builder_;
  std::map<std::pair<const Program*, Arguments>, std::vector<Field>> done_;
};

// Every call is counted with its body, equal ones too: an upper bound.
double expanded_size(const Program& program, std::map<const Program*, double>& sizes) {
  if (const auto known = sizes.find(&program); known != sizes.end()) return known->second;
  double size = 0;
  std::map<std::pair<const Program*, Arguments>, bool> called;
  for (const Instruction& in : program.code) {
    size += 1;
    if (in.op != Op::call) continue;
    const Program* body = program.calls[in.aux].body.get();
    if (called.try_emplace({body, {in.a, in.b, in.c}}, true).second) size += expanded_size(*body, sizes);
  }
  return sizes[&program] = size;
}

}  // namespace

double inlined_size(const Program& program) {
  std::map<const Program*, double> sizes;
  return expanded_size(program, sizes);
}

Program inline_bodies(const Program& program) {
  if (!program.has_calls()) return program;
  Builder builder;
  Inliner inliner(builder);
  const auto& fields = inliner.expand(program, {0, 1, 2});
  std::vector<std::pair<std::string, Field>> outputs;
  for (size_t i = 0; i < program.outputs.size(); ++i)
    outputs.emplace_back(program.output_names[i], fields[program.outputs[i]]);
  return builder.finish(outputs);
}

}  // namespace ombre::program

// Replaces calls by the code of their bodies. Equal calls share one copy.
#include <map>

#include "program/passes/passes.h"
#include "program/passes/replay.h"

namespace ombre::program {
namespace {

using Arguments = std::array<ValueId, 3>;

class Inliner {
 public:
  explicit Inliner(Builder& builder) : builder_(builder) {}

  // Returns the fields of all instructions of a program at the given inputs. Each body is expanded once for each place.
  const std::vector<Field>& expand(const Program& program, const Arguments& inputs) {
    auto [it, is_new] = done_.try_emplace({&program, inputs});
    if (!is_new) return it->second;
    std::vector<Field> fields =
        replay(builder_, program, {at(inputs[0]), at(inputs[1]), at(inputs[2])},
               [&](ValueId id, const std::vector<Field>& done) { return call(program, id, done); });
    return done_[{&program, inputs}] = std::move(fields);
  }

 private:
  Field at(ValueId id) { return {&builder_, id}; }

  std::optional<Field> call(const Program& program, ValueId id, const std::vector<Field>& done) {
    const Instruction& in = program.code[id];
    if (in.op != Op::call) return std::nullopt;
    const Call& called = program.calls[in.aux];
    const auto& body = expand(*called.body, {done[in.a].id, done[in.b].id, done[in.c].id});
    return body[called.body->outputs[called.output]];
  }

  Builder& builder_;
  std::map<std::pair<const Program*, Arguments>, std::vector<Field>> done_;
};

// Returns an upper bound of the size after inlining: calls are counted with their bodies, although equal calls in
// different programs may share a copy.
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

#include "program/program_text.h"

#include <map>

#include "base/system/assert.h"
#include "base/text/text.h"
#include "program/parts.h"
#include "program/passes/replay.h"

namespace ombre::program {
namespace {

std::string operands(const Instruction& in, int arity) {
  std::string text;
  const ValueId ids[] = {in.a, in.b, in.c};
  for (int i = 0; i < arity; ++i) text += " v" + std::to_string(ids[i]);
  return text;
}

std::string describe(const Program& program, const Instruction& in, std::map<const Program*, size_t>& bodies) {
  const OpInfo op = info(in.op);
  std::string text(op.name);
  switch (in.op) {
    case Op::input:
      return text + " " + std::string(1, static_cast<char>('x' + static_cast<int>(in.value)));
    case Op::constant:
      return text + " " + format_number(in.value);
    case Op::affine: {
      text += " [";
      for (const double m : program.maps[in.aux]) text += format_number(m) + " ";
      text.back() = ']';
      break;
    }
    case Op::source: {
      const Read& read = program.reads[in.aux];
      text += " \"" + read.source->name() + "\" channel " + std::to_string(read.channel);
      break;
    }
    case Op::call: {
      const Call& call = program.calls[in.aux];
      const size_t number = bodies.try_emplace(call.body.get(), bodies.size()).first->second;
      text += " body" + std::to_string(number) + "." + call.body->output_names[call.output];
      break;
    }
    case Op::parts: {
      const PartSet& set = *program.part_sets[in.aux];
      text += " slot " + format_number(in.value) + " of " + std::to_string(set.reference.size()) + " parts in " +
              std::to_string(set.reference.body_count()) + " kinds at";
      break;
    }
    default:
      break;
  }
  return text + operands(in, op.arity);
}

// Says how often a value that depends on these axes is computed.
std::string_view place(uint8_t mask) {
  constexpr std::string_view places[] = {
      "once", "each x", "each y", "each x and y", "each layer", "each x of each layer", "each row", "each voxel"};
  return places[mask];
}

void print(const Program& program, std::string& text, std::map<const Program*, size_t>& bodies) {
  const std::vector<uint8_t> masks = axis_masks(program);
  for (size_t i = 0; i < program.code.size(); ++i) {
    std::string line = "  v" + std::to_string(i) + " = " + describe(program, program.code[i], bodies);
    constexpr size_t column = 48;
    line.resize(std::max(line.size() + 2, column), ' ');
    text += line + "; " + std::string(place(masks[i])) + "\n";
  }
  for (size_t i = 0; i < program.outputs.size(); ++i)
    text += "  " + program.output_names[i] + " = v" + std::to_string(program.outputs[i]) + "\n";
}

}  // namespace

std::string to_text(const Program& program) {
  std::string text = "program\n";
  std::map<const Program*, size_t> bodies;
  print(program, text, bodies);
  // Printing a body may add further bodies.
  for (size_t done = 0; done < bodies.size(); ++done) {
    const Program* body = nullptr;
    for (const auto& [candidate, number] : bodies)
      if (number == done) body = candidate;
    text += "body" + std::to_string(done) + "\n";
    ASSERT(body);  // numbers are assigned from 0 without gaps
    print(*body, text, bodies);
  }
  return text;
}

}  // namespace ombre::program

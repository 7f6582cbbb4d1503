#include "render/ray_ends.h"

#include <string>
#include <string_view>

#include "program/passes/passes.h"

namespace ombre::render {
namespace {

// Collects the bytes of numbers.
class Bytes {
 public:
  template <class... Numbers>
  void add(Numbers... numbers) {
    (text_.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  }
  Hash hash() const { return hash_bytes(text_); }

 private:
  std::string text_ = "ends of rays ";
};

uintptr_t address_of(const void* thing) { return reinterpret_cast<uintptr_t>(thing); }

void add(Bytes& bytes, const program::Program& program) {
  bytes.add(program.code.size(), program.maps.size(), program.reads.size(), program.part_sets.size());
  for (const program::Instruction& in : program.code)
    bytes.add(static_cast<uint64_t>(in.op), in.a, in.b, in.c, in.aux, in.value);
  for (const program::AffineRow& row : program.maps) bytes.add(row);
  for (const program::Read& read : program.reads) bytes.add(address_of(read.source.get()), read.channel, read.tag);
  for (const auto& set : program.part_sets) bytes.add(address_of(set.get()));
  for (const program::ValueId output : program.outputs) bytes.add(output);
}

}  // namespace

program::Program shape_alone(const program::Program& traversal) {
  return program::shorten(traversal, std::vector<Interval>(traversal.code.size(), Interval::everything()));
}

std::optional<Hash> key_of_ends(const program::Program& shape, std::span<const double> where) {
  if (shape.has_calls()) return std::nullopt;
  Bytes bytes;
  add(bytes, shape);
  for (const double number : where) bytes.add(number);
  return bytes.hash();
}

}  // namespace ombre::render

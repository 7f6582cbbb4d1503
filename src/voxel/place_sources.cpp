#include "voxel/place_sources.h"

#include "program/passes/passes.h"

namespace ombre::voxel {
namespace {

template <class SamplerOf>
RowSamplers place(program::Program& program, SamplerOf sampler_of) {
  RowSamplers samplers;
  for (const program::Instruction& in : program.code) {
    if (in.op != program::Op::source) continue;
    program::Read& read = program.reads[in.aux];
    read.tag = static_cast<uint32_t>(samplers.size());
    samplers.push_back(sampler_of(read, in));
  }
  return samplers;
}

}  // namespace

Affine design_from_index(const Lattice& lattice) {
  const Vec3 size{lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()};
  Affine map = Affine::scaling(size);
  map.offset = lattice.center(0, 0, 0);
  return map;
}

RowSamplers place_sources(program::Program& program, const Affine& program_from_index) {
  return place(program, [&](const program::Read& read, const program::Instruction& in) {
    const auto map = program::affine_operands(program, in);
    return map ? read.source->rows(read.channel, *map * program_from_index) : nullptr;
  });
}

RowSamplers place_sources(program::Program& program, const program::RayLattice& rays,
                          std::span<const program::ValueId> base) {
  return place(program, [&](const program::Read& read, const program::Instruction& in) {
    const auto map = program::affine_operands(program, in, base);
    return map ? read.source->rays(read.channel, rays, *map) : nullptr;
  });
}

}  // namespace ombre::voxel

#include "voxel/layers.h"

#include <algorithm>

#include "program/passes/passes.h"
#include "voxel/tile.h"

namespace ombre::voxel {
namespace {

constexpr int64_t strip_rows = 64;

// Index (i, j, k) of a voxel to its centre.
Affine design_from_index(const Lattice& lattice) {
  const Vec3 size{lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()};
  Affine map = Affine::scaling(size);
  map.offset = lattice.center(0, 0, 0);
  return map;
}

}  // namespace

struct LayerEvaluator::Parts {
  MaterialProgram materials;
  Lattice lattice;
  Dither dither;
  uint64_t seed;
  std::vector<std::unique_ptr<program::RowSampler>> samplers;  // by tag

  // What is left of the program in a slab.
  program::Program program_for(const TileBox& slab) const {
    std::vector<Interval> values;
    program::evaluate_intervals(materials.program, centers(lattice, slab), values);
    return program::shorten(materials.program, values);
  }

  // Sources whose operands are affine in (x, y, z) are placed on the voxel rows, each placement once.
  void place_sources() {
    for (const program::Instruction& in : materials.program.code) {
      if (in.op != program::Op::source) continue;
      program::Read& read = materials.program.reads[in.aux];
      read.tag = static_cast<uint32_t>(samplers.size());
      const auto map = program::affine_operands(materials.program, in);
      samplers.push_back(map ? read.source->rows(read.channel, *map * design_from_index(lattice)) : nullptr);
    }
  }
};

LayerEvaluator::LayerEvaluator(MaterialProgram program, const Lattice& lattice, Dither dither, uint64_t seed)
    : parts_(std::make_unique<Parts>(Parts{std::move(program), lattice, dither, seed, {}})) {
  parts_->place_sources();
}

LayerEvaluator::~LayerEvaluator() = default;

std::vector<LayerResult> LayerEvaluator::layers(int64_t begin, int64_t end) const {
  const auto& count = parts_->lattice.count;
  std::vector<LayerResult> results(static_cast<size_t>(end - begin));
  std::vector<std::vector<CheckHits>> checks(results.size(), std::vector<CheckHits>(parts_->materials.check_count));
  for (LayerResult& layer : results) layer.runs = RunLayer(static_cast<uint32_t>(count[0]));
  const program::Program slab = parts_->program_for({{0, 0, begin}, {count[0], count[1], end}});
  StripEvaluator evaluator(parts_->materials, slab, parts_->lattice, parts_->dither, parts_->seed);
  std::vector<MaterialId> buffer;
  for (int64_t j = 0; j < count[1]; j += strip_rows) {
    const TileBox strip{{0, j, begin}, {count[0], std::min(j + strip_rows, count[1]), end}};
    const StripSources sources(parts_->samplers, strip);
    const bool touched = evaluator.run(strip, sources, buffer, checks);
    const MaterialId* voxels = buffer.data();
    for (LayerResult& layer : results) {
      for (int64_t row = strip.lo[1]; row < strip.hi[1]; ++row) {
        if (touched)
          layer.runs.append_row(voxels);
        else
          layer.runs.append_uniform_row(0);
        voxels += touched ? count[0] : 0;
      }
    }
  }
  for (size_t n = 0; n < results.size(); ++n) {
    results[n].checks = std::move(checks[n]);
    results[n].material_counts = count_materials(results[n].runs);
  }
  return results;
}

}  // namespace ombre::voxel

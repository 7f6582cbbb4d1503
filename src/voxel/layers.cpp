#include "voxel/layers.h"

#include <algorithm>
#include <cmath>

#include "base/system/assert.h"
#include "base/text/error.h"
#include "program/passes/narrow.h"
#include "voxel/place_sources.h"
#include "voxel/strip_diffusion.h"
#include "voxel/tile_traversal.h"

namespace ombre::voxel {
namespace {

constexpr int64_t strip_rows = 64;

// True if floats, which have 24 bits, resolve a hundredth of a voxel at the far end of the lattice.
bool floats_resolve(const Lattice& lattice) {
  const Box box = lattice.box();
  for (int axis = 0; axis < 3; ++axis) {
    const double farthest = std::max(std::abs(box.lo[axis]), std::abs(box.hi[axis]));
    if (farthest * 0x1p-24 > 0.01 * lattice.pitch[static_cast<size_t>(axis)].mm()) return false;
  }
  return true;
}

const eval::KernelSet& kernels_named(const std::string& name) {
  const auto& sets = eval::kernel_sets();
  ASSERT(!sets.empty() && "best_evaluator gives the reference then");
  if (name.empty()) return sets.front();
  const auto named =
      std::find_if(sets.begin(), sets.end(), [&](const eval::KernelSet& set) { return set.name == name; });
  ASSERT(named != sets.end() && "one of instruction_sets()");
  return *named;
}

}  // namespace

Evaluator best_evaluator(const Lattice& lattice) {
  return eval::kernel_sets().empty() || !floats_resolve(lattice) ? Evaluator::reference : Evaluator::batch;
}

struct LayerEvaluator::Parts {
  VoxelJob job;
  EvaluatorOptions options;
  RowSamplers samplers;
  std::vector<MaterialId> materials;

  bool is_batch() const { return options.evaluator == Evaluator::batch; }
  program::Precision precision() const {
    return is_batch() ? program::Precision::batch : program::Precision::reference;
  }

  std::unique_ptr<LeafEvaluator> make_leaf() const {
    return is_batch() ? batch_leaf(job, kernels_named(options.instruction_set)) : reference_leaf(job);
  }

  TraversalOptions traversal_options() const {
    TraversalOptions traversal;
    traversal.prune = options.prune;
    traversal.write_parts_out = options.write_parts_out;
    if (options.leaf_width > 0)
      traversal.leaf_width = traversal.small_leaf_width = traversal.widest = options.leaf_width;
    return traversal;
  }

  // Returns the program specialised to a slab.
  program::Remainder remainder(const TileBox& slab) const {
    const program::Program& whole = is_batch() ? job.selector.batch : job.selector.reference;
    return program::narrow(whole, centers(job.lattice, slab), precision());
  }
};

// Cuts out the part of whole layers that lies in a box.
std::vector<LayerResult> cut(std::vector<LayerResult> layers, const TileBox& box) {
  for (LayerResult& layer : layers) {
    RunLayer part(static_cast<uint32_t>(box.size(0)), static_cast<uint32_t>(box.size(1)));
    RunLayer& whole = layer.materials();
    std::vector<MaterialId> row(whole.width());
    for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      whole.row(static_cast<uint32_t>(j)).unpack(row.data());
      part.append_row(row.data() + box.lo[0]);
    }
    whole = std::move(part);
  }
  return layers;
}

// Appends rows of strips to the layers' runs. With error diffusion the rows pass a diffuser first.
class RowSink {
 public:
  // `begin` is the number of the first layer.
  RowSink(const LayerEvaluator::Parts& parts, std::vector<LayerResult>& layers, int64_t begin) : layers_(layers) {
    if (parts.job.dither != Dither::diffusion) return;
    kept_thresholds_ = parts.job.selector.threshold_count;
    for (size_t n = 0; n < layers.size(); ++n)
      diffusions_.emplace_back(parts.job.lattice.count[0], parts.materials, parts.job.seed,
                               begin + static_cast<int64_t>(n));
  }

  size_t kept_thresholds() const { return kept_thresholds_; }

  void take(const TileBox& strip, StripVoxels& voxels) {
    const std::vector<MaterialId> empty(voxels.touched() ? 0 : static_cast<size_t>(strip.size(0)), MaterialId{0});
    for (int64_t k = strip.lo[2]; k < strip.hi[2]; ++k) {
      const auto layer = static_cast<size_t>(k - strip.lo[2]);
      for (int64_t j = strip.lo[1]; j < strip.hi[1]; ++j) {
        const MaterialId* row = voxels.touched() ? voxels.at(strip.lo[0], j, k) : empty.data();
        if (!diffusions_.empty())
          diffusions_[layer].add(row, thresholds(voxels, j, k), [&](const MaterialId* made) { append(layer, made); });
        else if (voxels.touched())
          append(layer, row);
        else
          layers_[layer].materials().append_uniform_row(0);
      }
    }
  }

  void finish() {
    for (size_t layer = 0; layer < diffusions_.size(); ++layer)
      diffusions_[layer].finish([&](const MaterialId* made) { append(layer, made); });
  }

 private:
  void append(size_t layer, const MaterialId* row) { layers_[layer].materials().append_row(row); }

  std::vector<const float*> thresholds(StripVoxels& voxels, int64_t j, int64_t k) const {
    std::vector<const float*> rows;
    for (size_t t = 0; t < kept_thresholds_; ++t) rows.push_back(voxels.threshold(t, 0, j, k));
    return rows;
  }

  std::vector<LayerResult>& layers_;
  std::vector<LayerDiffusion> diffusions_;
  size_t kept_thresholds_ = 0;
};

LayerEvaluator::LayerEvaluator(const MaterialProgram& program, const Lattice& lattice, Dither dither, uint64_t seed,
                               const EvaluatorOptions& options)
    : parts_(std::make_unique<Parts>(Parts{{make_selector(program, dither), lattice, dither, seed}, options, {}, {}})) {
  Selector& selector = parts_->job.selector;
  parts_->materials = selector.materials;
  // For error diffusion, the traversal marks the inside with 1, and the materials are chosen later.
  if (dither == Dither::diffusion) selector.materials.assign(selector.materials.size(), MaterialId{1});
  parts_->samplers = place_sources(selector.reference, design_from_index(lattice));
  if (parts_->is_batch()) make_batch(selector);
}

LayerEvaluator::~LayerEvaluator() = default;

size_t working_bytes(const Lattice& lattice, int64_t slab_layers, Dither dither, size_t material_count) {
  const size_t thresholds = dither == Dither::diffusion && material_count > 1 ? material_count - 1 : 0;
  const auto voxels = static_cast<size_t>(lattice.count[0] * std::min(strip_rows, lattice.count[1]) * slab_layers);
  return voxels * (sizeof(MaterialId) + thresholds * sizeof(float));
}

std::vector<LayerResult> LayerEvaluator::layers(int64_t begin, int64_t end, const StopFlag* stop) const {
  const auto& count = parts_->job.lattice.count;
  return region({{0, 0, begin}, {count[0], count[1], end}}, stop);
}

std::vector<LayerResult> LayerEvaluator::region(const TileBox& box, const StopFlag* stop) const {
  const auto& count = parts_->job.lattice.count;
  const bool is_whole = box.size(0) == count[0] && box.size(1) == count[1];
  if (parts_->job.dither == Dither::diffusion && !is_whole) return cut(layers(box.lo[2], box.hi[2], stop), box);
  std::vector<LayerResult> results(static_cast<size_t>(box.size(2)));
  const size_t check_count = parts_->job.selector.check_count;
  std::vector<std::vector<CheckHits>> checks(results.size(), std::vector<CheckHits>(check_count));
  for (LayerResult& layer : results)
    layer.channels.emplace_back(RunLayer(static_cast<uint32_t>(box.size(0)), static_cast<uint32_t>(box.size(1))));
  const program::Remainder slab = parts_->remainder(box);
  const auto leaf = parts_->make_leaf();
  TileTraversal traversal(parts_->job, parts_->precision(), parts_->traversal_options(), *leaf);
  RowSink sink(*parts_, results, box.lo[2]);
  StripVoxels voxels;
  for (int64_t j = box.lo[1]; j < box.hi[1]; j += strip_rows) {
    if (stop && stop->requested()) throw Cancelled();
    TileBox strip = box;
    strip.lo[1] = j;
    strip.hi[1] = std::min(j + strip_rows, box.hi[1]);
    const StripSources sources(parts_->samplers, strip);
    voxels.begin(strip, checks, sink.kept_thresholds());
    traversal.run(slab.program, slab.ranges, strip, sources, voxels);
    sink.take(strip, voxels);
  }
  sink.finish();
  for (size_t n = 0; n < results.size(); ++n) results[n].checks = std::move(checks[n]);
  return results;
}

}  // namespace ombre::voxel

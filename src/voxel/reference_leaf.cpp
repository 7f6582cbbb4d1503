// Evaluates tiles in double precision, which is the reference for other evaluators.
#include "eval/rows.h"
#include "program/passes/passes.h"
#include "voxel/draws.h"
#include "voxel/leaf.h"

namespace ombre::voxel {
namespace {

class ReferenceLeaf : public LeafEvaluator {
 public:
  explicit ReferenceLeaf(const VoxelJob& job) : job_(job) {}

  void evaluate(const program::Program& program, const std::vector<Interval>&, const TileBox& tile,
                const StripSources& sources, StripVoxels& voxels) override {
    program::Program ordered = program;
    const size_t early = program::order_for_first(ordered);
    xs_.clear();
    for (int64_t i = tile.lo[0]; i < tile.hi[0]; ++i) xs_.push_back(job_.lattice.center(i, 0, 0).x);
    if (rows_.width() < xs_.size()) rows_ = eval::RowEvaluator(xs_.size());
    for (int64_t k = tile.lo[2]; k < tile.hi[2]; ++k)
      for (int64_t j = tile.lo[1]; j < tile.hi[1]; ++j) evaluate_row(ordered, early, tile, j, k, sources, voxels);
  }

 private:
  void evaluate_row(const program::Program& program, size_t early, const TileBox& tile, int64_t j, int64_t k,
                    const StripSources& sources, StripVoxels& voxels) {
    const Vec3 p = job_.lattice.center(tile.lo[0], j, k);
    const eval::SourceRow source_row = [&](const program::Read& read, std::span<double> values) {
      if (!sources.has(read.tag)) return false;
      sources.fill(read.tag, tile.lo[0], j, k, values);
      return true;
    };
    rows_.set_row(xs_, p.y, p.z);
    rows_.run(program, 0, early, source_row);
    const auto inside = rows_.values(program.outputs[0]);
    if (std::all_of(inside.begin(), inside.end(), [](double v) { return v == 0; })) return;
    rows_.run(program, early, program.code.size(), source_row);
    const Draws draws = draws_of_row(job_, j, k);
    MaterialId* out = voxels.at(tile.lo[0], j, k);
    for (size_t n = 0; n < inside.size(); ++n)
      if (inside[n] != 0) out[n] = choose(program, n, tile.lo[0] + static_cast<int64_t>(n), j, k, draws, voxels);
  }

  MaterialId choose(const program::Program& program, size_t n, int64_t i, int64_t j, int64_t k, const Draws& draws,
                    StripVoxels& voxels) {
    const Selector& selector = job_.selector;
    thresholds_.clear();
    for (size_t t = 0; t < selector.threshold_count; ++t)
      thresholds_.push_back(rows_.values(program.outputs[1 + t])[n]);
    for (size_t t = 0; t < voxels.kept_thresholds(); ++t)
      *voxels.threshold(t, i, j, k) = static_cast<float>(thresholds_[t]);
    for (size_t c = 0; c < selector.check_count; ++c)
      if (rows_.values(program.outputs[1 + selector.threshold_count + c])[n] != 0) voxels.note_check(c, i, j, k);
    return selector.materials[first_above<double>(thresholds_, draw(draws, i) * 0x1p-24)];
  }

  const VoxelJob& job_;
  eval::RowEvaluator rows_{64};
  std::vector<double> xs_, thresholds_;
};

}  // namespace

std::unique_ptr<LeafEvaluator> reference_leaf(const VoxelJob& job) { return std::make_unique<ReferenceLeaf>(job); }

}  // namespace ombre::voxel

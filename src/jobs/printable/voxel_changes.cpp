#include "jobs/printable/voxel_changes.h"

#include <algorithm>

#include "base/system/tasks.h"

namespace ombre::compile {
namespace {

// Makes layers of a plan with changes.
class ChangedLayers {
 public:
  ChangedLayers(const Plan& plan, VoxelChangesPtr changes)
      : producer_(plan.producer), stages_(plan.stages), changes_(std::move(changes)), before_(plan.request.lattice) {
    checks_.resize(plan.request.check_texts.size());
    for (size_t axis = 0; axis < 3; ++axis) {
      lo_[axis] = std::min<int64_t>(0, changes_->box().lo[axis]);
      count_[axis] = std::max(before_.count[axis], changes_->box().hi[axis]) - lo_[axis];
    }
  }

  voxel::Lattice lattice() const {
    voxel::Lattice grown = before_;
    grown.count = count_;
    for (size_t axis = 0; axis < 3; ++axis)
      grown.origin[static_cast<int>(axis)] += before_.pitch[axis].times(static_cast<double>(lo_[axis]));
    return grown;
  }

  std::vector<voxel::LayerResult> layers(int64_t begin, int64_t end, const StopFlag* stop) const {
    const int64_t from = std::clamp<int64_t>(begin + lo_[2], 0, before_.count[2]),
                  to = std::clamp<int64_t>(end + lo_[2], 0, before_.count[2]);
    std::vector<voxel::LayerResult> made;
    if (from < to) made = producer_(from, to, stop);
    std::vector<voxel::LayerResult> result;
    for (int64_t k = begin + lo_[2]; k < end + lo_[2]; ++k) {
      const bool is_there = k >= from && k < to;
      result.push_back(changed(k, is_there ? std::move(made[static_cast<size_t>(k - from)]) : blank()));
    }
    return result;
  }

 private:
  voxel::LayerResult blank() const {
    voxel::LayerResult layer;
    RunLayer rows(static_cast<uint32_t>(before_.count[0]));
    for (int64_t j = 0; j < before_.count[1]; ++j) rows.append_uniform_row(0);
    layer.channels.emplace_back(std::move(rows));
    layer.checks = checks_;
    return layer;
  }

  voxel::LayerResult changed(int64_t k, voxel::LayerResult layer) const {
    for (voxel::CheckHits& hits : layer.checks)
      for (size_t axis = 0; axis < 3; ++axis) hits.first[axis] -= lo_[axis];
    const auto its = changes_->layers().find(k);
    const bool has_changes = its != changes_->layers().end();
    if (!has_changes && count_ == before_.count) return layer;
    std::vector<std::vector<ChangedRun>> of_row(static_cast<size_t>(count_[1]));
    if (has_changes)
      for (const ChangedRun& run : its->second) of_row[static_cast<size_t>(run.j - lo_[1])].push_back(run);
    layer.materials() = with_changes(layer.materials(), of_row);
    return layer;
  }

  RunLayer with_changes(const RunLayer& rows, const std::vector<std::vector<ChangedRun>>& of_row) const {
    RunLayer result(static_cast<uint32_t>(count_[0]), static_cast<uint32_t>(count_[1]));
    std::vector<MaterialId> row(static_cast<size_t>(count_[0]));
    for (int64_t j = lo_[1]; j < count_[1] + lo_[1]; ++j) {
      std::ranges::fill(row, MaterialId{0});
      if (j >= 0 && j < before_.count[1]) rows.row(static_cast<uint32_t>(j)).unpack(row.data() - lo_[0]);
      for (const ChangedRun& run : of_row[static_cast<size_t>(j - lo_[1])])
        std::fill(row.begin() + (run.begin - lo_[0]), row.begin() + (run.end - lo_[0]), run.to);
      result.append_row(row.data());
    }
    return result;
  }

  LayerProducer producer_;
  JobStagesPtr stages_;
  VoxelChangesPtr changes_;
  voxel::Lattice before_;
  std::vector<voxel::CheckHits> checks_;
  std::array<int64_t, 3> lo_{}, count_{};  // the grown lattice, in voxels of the one before
};

using Gains = std::map<MaterialId, int64_t>;

void add_gains(const RunLayer* rows, const std::vector<ChangedRun>& runs, Gains& gains) {
  std::vector<MaterialId> row(rows ? rows->width() : 0);
  for (const ChangedRun& run : runs) {
    const bool has_row = rows && run.j >= 0 && run.j < static_cast<int64_t>(rows->height());
    if (has_row) rows->row(static_cast<uint32_t>(run.j)).unpack(row.data());
    for (int64_t i = run.begin; i < run.end; ++i) {
      const bool is_there = has_row && i >= 0 && i < static_cast<int64_t>(row.size());
      const MaterialId from = is_there ? row[static_cast<size_t>(i)] : MaterialId{0};
      --gains[from], ++gains[run.to];
    }
  }
}

}  // namespace

void VoxelChanges::add(int64_t k, const ChangedRun& run) {
  const IndexBox of_run{{run.begin, run.j, k}, {run.end, run.j + 1, k + 1}};
  const bool is_first = layers_.empty();
  for (size_t axis = 0; axis < 3; ++axis) {
    box_.lo[axis] = is_first ? of_run.lo[axis] : std::min(box_.lo[axis], of_run.lo[axis]);
    box_.hi[axis] = is_first ? of_run.hi[axis] : std::max(box_.hi[axis], of_run.hi[axis]);
  }
  layers_[k].push_back(run);
}

void VoxelChanges::add(int64_t k, const BitLayer& flags, int64_t margin, MaterialId to) {
  for (int64_t j = 0; j < flags.height(); ++j)
    each_run(flags, j, [&](int64_t begin, int64_t end) { add(k, {j - margin, begin - margin, end - margin, to}); });
}

Plan changed_plan(const Plan& plan, const VoxelChangesPtr& changes) {
  const auto layers = std::make_shared<const ChangedLayers>(plan, changes);
  Plan changed;
  changed.request = plan.request;
  changed.request.lattice = layers->lattice();
  changed.stages = plan.stages;
  changed.producer = [layers](int64_t begin, int64_t end, const StopFlag* stop) {
    return layers->layers(begin, end, stop);
  };
  return changed;
}

Gains gained_voxels(const Plan& plan, const VoxelChanges& changes, const CheckRun& run) {
  std::vector<int64_t> layers;
  for (const auto& [k, runs] : changes.layers()) layers.push_back(k);
  Gains sums;
  run_ordered<Gains>(
      layers.size(), run.threads, 16,
      [&](size_t n) {
        const int64_t k = layers[n];
        Gains gains;
        std::vector<voxel::LayerResult> made;
        if (k >= 0 && k < plan.request.lattice.count[2]) made = plan.producer(k, k + 1, run.stop);
        add_gains(made.empty() ? nullptr : &made.front().materials(), changes.layers().at(k), gains);
        return gains;
      },
      [&](size_t, Gains& gains) {
        for (const auto& [material, voxels] : gains) sums[material] += voxels;
      });
  sums.erase(0);
  return sums;
}

}  // namespace ombre::compile

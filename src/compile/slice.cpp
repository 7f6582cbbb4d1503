// Slicing: evaluates layers slab by slab and writes them to a job folder as PNG files.
#include "compile/slice.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "base/error.h"
#include "base/tasks.h"
#include "compile/job_folder.h"
#include "compile/slice_work.h"

namespace ombre::compile {
namespace {

LayerRange layers_asked_for(const SliceRequest& request, const SliceOptions& options) {
  const LayerRange whole{0, request.lattice.count[2]};
  const LayerRange asked = options.layers.value_or(whole);
  return {std::clamp(asked.begin, whole.begin, whole.end), std::clamp(asked.end, whole.begin, whole.end)};
}

// Tells how many voxels of the layers asked for are done.
class VoxelProgress {
 public:
  VoxelProgress(Progress* progress, const SliceRequest& request, LayerRange layers)
      : progress_(progress),
        layer_voxels_(static_cast<uint64_t>(request.lattice.count[0]) *
                      static_cast<uint64_t>(request.lattice.count[1])),
        total_(static_cast<uint64_t>(layers.end - layers.begin)) {}

  void add_layers(size_t count) {
    done_ += count;
    if (progress_) progress_->update(done_ * layer_voxels_, total_ * layer_voxels_);
  }

 private:
  Progress* progress_;
  uint64_t layer_voxels_, total_, done_ = 0;
};

// One run over the layers that are missing.
class SliceRun {
 public:
  SliceRun(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options, Progress* progress,
           const StopFlag* stop)
      : request_(request),
        producer_(producer),
        options_(options),
        stop_(stop),
        size_(size_work(request, options)),
        folder_(options.folder, request, options.use, size_.threads),
        layers_(layers_asked_for(request, options)),
        progress_(progress, request, layers_) {}

  SliceReport run() {
    const std::vector<LayerRange> slabs = missing_slabs(layers_, folder_.finished(), size_.slab_layers);
    count_finished();
    if (!failed_check_) write(slabs);
    report_.whole_job_finished = folder_.close();
    if (skipped_ && !failed_check_) throw Cancelled();
    finish_report();
    return std::move(report_);
  }

 private:
  using Slab = std::vector<EncodedLayer>;

  void count_finished() {
    for (const auto& [layer, entry] : folder_.finished()) {
      if (layer < layers_.begin || layer >= layers_.end) continue;
      ++report_.layers_kept;
      note_checks(entry);
    }
    progress_.add_layers(static_cast<size_t>(report_.layers_kept));
  }

  void write(const std::vector<LayerRange>& slabs) {
    const exporting::MaterialStack stack = image_stack(request_);
    // Slabs not begun when the run is to stop come back empty; those in flight are still written.
    const auto produce = [&](size_t i) {
      if (failed_check_ || (stop_ && stop_->requested())) {
        skipped_ = true;
        return Slab();
      }
      return make_slab(request_, producer_, stack, slabs[i]);
    };
    const auto consume = [&](size_t, Slab& slab) { write_slab(slab); };
    run_ordered<Slab>(slabs.size(), size_.threads, size_.window, produce, consume);
  }

  void write_slab(Slab& slab) {
    for (EncodedLayer& layer : slab) {
      ++(layer.images.empty() ? report_.layers_dropped : report_.layers_written);
      report_.bytes_written += layer.bytes();
      note_checks(layer.entry);
      folder_.add(std::move(layer.entry), layer.images);
    }
    progress_.add_layers(slab.size());
  }

  void note_checks(const JournalEntry& entry) {
    const auto hit = [](const voxel::CheckHits& hits) { return hits.count > 0; };
    if (options_.strict && std::any_of(entry.checks.begin(), entry.checks.end(), hit)) failed_check_ = true;
  }

  void finish_report() {
    report_.layers = layers_;
    report_.stopped_by_check = failed_check_;
    report_.material_voxels.resize(request_.materials.size());
    CheckSums checks(request_);
    for (const auto& [layer, entry] : folder_.finished()) {
      if (layer < layers_.begin || layer >= layers_.end) continue;
      for (size_t i = 0; i < entry.voxels.size(); ++i) report_.material_voxels[i] += entry.voxels[i];
      checks.add(entry.checks);
    }
    for (const uint64_t voxels : report_.material_voxels) report_.voxels_inside += voxels;
    report_.checks = checks.reports();
  }

  const SliceRequest& request_;
  const LayerProducer& producer_;
  const SliceOptions& options_;
  const StopFlag* stop_;
  WorkSize size_;
  JobFolder folder_;
  LayerRange layers_;
  VoxelProgress progress_;
  SliceReport report_;
  std::atomic<bool> skipped_{false}, failed_check_{false};
};

}  // namespace

SliceReport slice(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options,
                  Progress* progress, const StopFlag* stop) {
  const auto start = std::chrono::steady_clock::now();
  SliceReport report = SliceRun(request, producer, options, progress, stop).run();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace ombre::compile

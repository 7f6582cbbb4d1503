// Evaluates layers slab by slab and writes them to a job folder as PNG files.
#include "jobs/slice/slice.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include "base/system/assert.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "base/text/error.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/slice/forecast.h"
#include "jobs/slice/slice_work.h"
#include "jobs/slice/stored_slices.h"
#include "jobs/slice/stored_stages.h"
#include "stores/open_store.h"

namespace ombre::compile {
namespace {

LayerRange requested_layers(const SliceRequest& request, const SliceOptions& options) {
  const LayerRange whole{0, request.lattice.count[2]};
  const LayerRange requested = options.layers.value_or(whole);
  return {std::clamp(requested.begin, whole.begin, whole.end), std::clamp(requested.end, whole.begin, whole.end)};
}

std::unique_ptr<stores::Store> open_store(const SliceOptions& options, const StoredSlices& slices,
                                          const stores::Checking& checking) {
  if (options.shard) return stores::open_shard(options.folder, slices, *options.shard, checking);
  return stores::open_store(options.folder, slices, options.use, checking);
}

// Reports how many voxels of the requested layers are done, and the time left.
class VoxelProgress {
 public:
  VoxelProgress(Progress* progress, const SliceRequest& request, LayerRange layers)
      : progress_(progress),
        layer_voxels_(static_cast<uint64_t>(request.lattice.count[0]) *
                      static_cast<uint64_t>(request.lattice.count[1])),
        total_(static_cast<uint64_t>(layers.end - layers.begin)) {}

  bool is_watched() const { return progress_ != nullptr; }

  void add_layers(size_t count, const Forecast& forecast) {
    done_ += count;
    if (!progress_) return;
    HowFar how_far{done_ * layer_voxels_, total_ * layer_voxels_};
    if (const auto left = forecast.left()) {
      how_far.seconds_left = left->seconds;
      how_far.bytes_left = left->bytes;
    }
    progress_->update(how_far);
  }

 private:
  Progress* progress_;
  uint64_t layer_voxels_, total_, done_ = 0;
};

// A run over the layers that are missing.
class SliceRun {
 public:
  SliceRun(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options, Progress* progress,
           const StopFlag* stop)
      : request_(request),
        producer_(producer),
        options_(options),
        watched_(progress),
        stop_(stop),
        size_(size_work(request, options)),
        slices_(request),
        store_(open_store(options, slices_, {size_.threads, progress, stop})),
        stages_(stores::pieces_folder(options.folder), options.use, {size_.threads, progress, stop}),
        shared_stages_(stores::pieces_folder(options.folder), {size_.threads, progress, stop}),
        layers_(requested_layers(request, options)),
        slabs_(missing_slabs(layers_, store_->finished(), size_.slab_layers)),
        forecast_(slabs_, size_.threads),
        progress_(progress, request, layers_) {}

  SliceReport run() {
    count_finished();
    if (!failed_check_ && prepare_stages() && !options_.only_stages) write();
    report_.whole_job_finished = !options_.shard && slices_.is_complete(store_->finished());
    if (report_.whole_job_finished) stages_.remove();
    store_->close();
    if (skipped_ && !failed_check_) throw Cancelled();
    finish_report();
    return std::move(report_);
  }

 private:
  struct Slab {
    std::vector<EncodedLayer> layers;
    LayerCost cost;
  };

  void count_finished() {
    for (const auto& [layer, entry] : slices_.layers(store_->finished())) {
      if (layer < layers_.begin || layer >= layers_.end) continue;
      ++report_.layers_kept;
      note_checks(entry);
    }
    progress_.add_layers(static_cast<size_t>(report_.layers_kept), forecast_);
  }

  // Returns false when the run is to stop.
  bool prepare_stages() {
    if (!options_.stages || slabs_.empty()) return true;
    try {
      StageLoan loan = stage_loan(options_, watched_, stop_);
      loan.keeper = &stages_;
      if (options_.shard) loan.keeper = &shared_stages_;  // other processes need the same stages
      options_.stages->prepare(loan);
    } catch (const Cancelled&) {
      skipped_ = true;
    }
    return !skipped_;
  }

  void write() {
    const auto produce = [&](size_t i) {
      sample_ahead();
      return make(slabs_[i]);
    };
    const auto consume = [&](size_t i, Slab& slab) { write_slab(slabs_[i], slab); };
    run_ordered<Slab>(slabs_.size(), size_.threads, size_.window, produce, consume);
  }

  bool is_stopping() const { return failed_check_ || (stop_ && stop_->requested()); }

  // Makes the layers of a slab. If the run is to stop, it returns only those that are encoded, which are still written.
  Slab make(LayerRange range) {
    Slab slab;
    const Stopwatch watch;
    try {
      if (!is_stopping()) slab.layers = make_slab(request_, producer_, stack_, range, stop_);
    } catch (const Cancelled&) {
      ASSERT(slab.layers.empty());
    }
    slab.cost.seconds = watch.seconds();
    for (const EncodedLayer& layer : slab.layers) slab.cost.bytes += static_cast<double>(layer.bytes());
    return slab;
  }

  static bool is_whole(LayerRange range, const Slab& slab) {
    return slab.layers.size() == static_cast<size_t>(range.end - range.begin);
  }

  void sample_ahead() {
    if (!progress_.is_watched() || is_stopping()) return;
    const std::optional<LayerRange> range = forecast_.sample_ahead();
    if (!range) return;
    const Slab slab = make(*range);
    if (is_whole(*range, slab)) forecast_.add_sample(*range, slab.cost);
  }

  void write_slab(LayerRange range, Slab& slab) {
    const Stopwatch watch;
    for (EncodedLayer& layer : slab.layers) {
      ++(layer.images.empty() ? report_.layers_dropped : report_.layers_written);
      report_.bytes_written += layer.bytes();
      note_checks(layer.entry);
      store_->put(slices_.piece(layer.entry, std::move(layer.images)));
    }
    if (is_whole(range, slab))
      forecast_.add_written(slab.cost, watch.seconds());
    else
      skipped_ = true;
    progress_.add_layers(slab.layers.size(), forecast_);
  }

  void note_checks(const LayerEntry& entry) {
    const auto hit = [](const voxel::CheckHits& hits) { return hits.count > 0; };
    if (options_.strict && std::any_of(entry.checks.begin(), entry.checks.end(), hit)) failed_check_ = true;
  }

  void finish_report() {
    report_.layers = layers_;
    report_.stopped_by_check = failed_check_;
    report_.counts = no_counts(request_);
    CheckSums checks(request_);
    for (const auto& [layer, entry] : slices_.layers(store_->finished())) {
      if (layer < layers_.begin || layer >= layers_.end) continue;
      report_.counts.add(entry.counts);
      checks.add(entry.checks);
    }
    for (const uint64_t voxels : report_.counts.voxels) report_.voxels_inside += voxels;
    report_.checks = checks.reports();
  }

  const SliceRequest& request_;
  const LayerProducer& producer_;
  const SliceOptions& options_;
  Progress* watched_;
  const StopFlag* stop_;
  WorkSize size_;
  StoredSlices slices_;
  std::unique_ptr<stores::Store> store_;
  StoredStages stages_;
  SharedStages shared_stages_;
  LayerRange layers_;
  const std::vector<LayerRange> slabs_;  // slabs that are missing
  Forecast forecast_;
  VoxelProgress progress_;
  const exporting::ImageStack stack_ = image_stack(request_);
  SliceReport report_;
  bool skipped_ = false;
  std::atomic<bool> failed_check_{false};
};

}  // namespace

SliceReport slice(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options,
                  Progress* progress, const StopFlag* stop) {
  const Stopwatch watch;
  if (options.stages) options.stages->check_memory(stage_loan(options, progress, stop));
  const SliceOptions for_layers = without_stages_memory(options);
  SliceReport report = SliceRun(request, producer, for_layers, progress, stop).run();
  report.seconds = watch.seconds();
  return report;
}

}  // namespace ombre::compile

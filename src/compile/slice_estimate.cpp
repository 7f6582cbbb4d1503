// What a slice job will take, from a few of its layers.
#include <map>
#include <optional>

#include "base/error.h"
#include "base/stopwatch.h"
#include "base/tasks.h"
#include "compile/forecast.h"
#include "compile/slice_work.h"

namespace ombre::compile {
namespace {

constexpr size_t most_samples = 64;
constexpr double most_seconds = 2, deadline_seconds = 4;  // no slab is begun, none goes on
// Of a disk that is not busy.
constexpr double seconds_for_a_file = 50e-6, seconds_for_a_byte = 1 / 1.5e9;

double guess_writing_seconds(const SliceRequest& request, LayerRange range, double bytes) {
  const double files = request.files.has_material() ? static_cast<double>(request.materials.size()) : 1;
  return static_cast<double>(range.end - range.begin) * files * seconds_for_a_file + bytes * seconds_for_a_byte;
}

struct Sample {
  LayerRange slab;
  LayerCost cost;
  std::vector<JournalEntry> layers;
};

Sample take_sample(const SliceRequest& request, const LayerProducer& producer, const exporting::MaterialStack& stack,
                   LayerRange slab, const StopFlag* stop) {
  Sample sample;
  sample.slab = slab;
  const Stopwatch watch;
  for (EncodedLayer& layer : make_slab(request, producer, stack, slab, stop)) {
    sample.cost.bytes += static_cast<double>(layer.bytes());
    sample.layers.push_back(std::move(layer.entry));
  }
  sample.cost.seconds = watch.seconds();
  return sample;
}

// By layer, what samples say of checks.
class SampledChecks {
 public:
  void add(const Sample& sample) {
    for (const JournalEntry& entry : sample.layers) layers_[entry.layer] = entry.checks;
  }
  std::vector<CheckReport> reports(const SliceRequest& request) const {
    CheckSums sums(request);
    for (const auto& [layer, checks] : layers_) sums.add(checks);
    return sums.reports();
  }

 private:
  std::map<int64_t, std::vector<voxel::CheckHits>> layers_;
};

// Follows the progress of stages that take longer than an estimate may.
class StagePace final : public Progress {
 public:
  void update(const HowFar&) override {}
  void preparing(const std::string&, const HowFar& how_far) override {
    if (how_far.seconds_left >= 0) seconds_ = watch_.seconds() + how_far.seconds_left;
  }
  // Nothing while too little is known.
  std::optional<double> seconds() const { return seconds_; }

 private:
  Stopwatch watch_;
  std::optional<double> seconds_;
};

struct StageEstimate {
  double seconds = 0;
  bool is_least = false;
};

// Stages that are not ready in time are left out of the layers.
StageEstimate estimate_stages(const SliceOptions& options, const StopFlag* stop) {
  if (!options.stages || options.stages->is_prepared()) return {};
  const Stopwatch watch;
  const StopFlag deadline(stop, most_seconds);
  StagePace pace;
  StageEstimate estimate;
  try {
    options.stages->prepare(stage_loan(options, &pace, &deadline));
    estimate.seconds = watch.seconds();
  } catch (const Cancelled&) {
    if (stop && stop->requested()) throw;
    options.stages->leave_out_unprepared();
    estimate = {pace.seconds().value_or(watch.seconds()), !pace.seconds()};
  }
  options.stages->lend(stage_loan(options, nullptr, stop));
  return estimate;
}

}  // namespace

SliceEstimate estimate_slice(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& whole,
                             const StopFlag* stop) {
  const StageEstimate stages = estimate_stages(whole, stop);
  const SliceOptions options = without_stages_memory(whole);
  const LayerRange range = options.layers.value_or(LayerRange{0, request.lattice.count[2]});
  const WorkSize size = size_work(request, options);
  const exporting::MaterialStack stack = image_stack(request);
  std::vector<LayerRange> slabs = spread(missing_slabs(range, {}, size.slab_layers), most_samples);
  // What comes first meets cold caches: each thread begins with the same slab, which is then looked at again.
  if (!slabs.empty()) slabs.insert(slabs.begin(), static_cast<size_t>(size.threads), slabs.front());

  CostProfile profile;
  SampledChecks checks;
  const Stopwatch watch;
  const StopFlag deadline(stop, deadline_seconds);
  const auto produce = [&](size_t i) -> std::optional<Sample> {
    if (i > 0 && watch.seconds() > most_seconds) return std::nullopt;
    try {
      Sample sample = take_sample(request, producer, stack, slabs[i], &deadline);
      if (!deadline.requested()) return sample;
    } catch (const Cancelled&) {
    }
    return std::nullopt;
  };
  const auto consume = [&](size_t, const std::optional<Sample>& sample) {
    if (!sample) return;
    profile.add(sample->slab, sample->cost);
    checks.add(*sample);
  };
  run_ordered<std::optional<Sample>>(slabs.size(), size.threads, size.window, produce, consume);
  if (stop && stop->requested()) throw Cancelled();

  SliceEstimate estimate;
  const bool is_unknown = profile.is_empty() && !slabs.empty();
  estimate.is_least = is_unknown || stages.is_least;
  if (is_unknown) profile.add(slabs[0], {watch.seconds(), 0});
  const LayerCost cost = profile.of(range);
  estimate.seconds =
      stages.seconds + wall_seconds(cost.seconds, guess_writing_seconds(request, range, cost.bytes), size.threads);
  estimate.bytes = static_cast<uint64_t>(cost.bytes);
  estimate.memory_bytes = size.memory_bytes + (whole.memory_bytes - options.memory_bytes);
  estimate.checks = checks.reports(request);
  return estimate;
}

}  // namespace ombre::compile

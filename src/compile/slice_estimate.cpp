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

}  // namespace

SliceEstimate estimate_slice(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options,
                             const StopFlag* stop) {
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
  estimate.is_least = profile.is_empty() && !slabs.empty();
  if (estimate.is_least) profile.add(slabs[0], {watch.seconds(), 0});
  const LayerCost cost = profile.of(range);
  estimate.seconds = wall_seconds(cost.seconds, guess_writing_seconds(request, range, cost.bytes), size.threads);
  estimate.bytes = static_cast<uint64_t>(cost.bytes);
  estimate.memory_bytes = size.memory_bytes;
  estimate.checks = checks.reports(request);
  return estimate;
}

}  // namespace ombre::compile

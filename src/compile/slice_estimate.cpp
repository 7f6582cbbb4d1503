// What a slice job will take, from a few of its layers.
#include <algorithm>
#include <chrono>

#include "compile/slice_work.h"

namespace ombre::compile {
namespace {

constexpr int64_t most_samples = 9;
constexpr double most_seconds = 2;

// Slabs spread over the range, the middle first: there, most parts are widest.
std::vector<LayerRange> sample_slabs(LayerRange range, int64_t slab_layers) {
  std::vector<LayerRange> slabs;
  const int64_t count = range.end - range.begin;
  const int64_t samples = std::min(most_samples, (count + slab_layers - 1) / slab_layers);
  for (int64_t i = 0; i < samples; ++i) {
    const int64_t place = (samples / 2 + (i % 2 == 0 ? i / 2 : samples - (i + 1) / 2)) % samples;
    const int64_t begin = range.begin + place * count / samples;
    const int64_t next = range.begin + (place + 1) * count / samples;
    slabs.push_back({begin, std::min(begin + slab_layers, next)});
  }
  return slabs;
}

}  // namespace

SliceEstimate estimate_slice(const SliceRequest& request, const LayerProducer& producer, const SliceOptions& options) {
  using Clock = std::chrono::steady_clock;
  const LayerRange range = options.layers.value_or(LayerRange{0, request.lattice.count[2]});
  const WorkSize size = size_work(request, options);
  const exporting::MaterialStack stack = image_stack(request);

  SliceEstimate estimate;
  estimate.memory_bytes = size.memory_bytes;
  std::vector<EncodedLayer> sampled;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  for (const LayerRange& slab : sample_slabs(range, size.slab_layers)) {
    for (EncodedLayer& layer : make_slab(request, producer, stack, slab)) {
      estimate.bytes += layer.bytes();
      sampled.push_back(std::move(layer));
      sampled.back().images.clear();
    }
    if (elapsed() > most_seconds) break;
  }
  if (sampled.empty()) return estimate;

  const double share = static_cast<double>(range.end - range.begin) / static_cast<double>(sampled.size());
  estimate.seconds = elapsed() * share / size.threads;
  estimate.bytes = static_cast<uint64_t>(static_cast<double>(estimate.bytes) * share);

  std::sort(sampled.begin(), sampled.end(),
            [](const EncodedLayer& a, const EncodedLayer& b) { return a.entry.layer < b.entry.layer; });
  CheckSums checks(request);
  for (const EncodedLayer& layer : sampled) checks.add(layer.entry.checks);
  estimate.checks = checks.reports();
  return estimate;
}

}  // namespace ombre::compile

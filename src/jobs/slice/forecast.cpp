// Forecasts the rest of a running job.
#include "jobs/slice/forecast.h"

#include <algorithm>

#include "base/system/assert.h"
#include "base/system/tasks.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

constexpr size_t most_samples = 15, least_samples = 3;
constexpr size_t slabs_for_a_sample = 64;  // so that sampling ahead costs little

}  // namespace

double wall_seconds(double producing, double writing, int threads) {
  const int together = std::clamp(threads, 1, core_count());
  return std::max(writing, (producing + writing) / together);
}

Forecast::Forecast(std::vector<LayerRange> slabs, int threads, double patience)
    : slabs_(std::move(slabs)), samples_(spread(slabs_, most_samples)), threads_(threads), patience_(patience) {
  for (const LayerRange& slab : slabs_) layer_count_ += slab.end - slab.begin;
}

size_t Forecast::samples_wanted() const {
  return std::min(samples_.size(), (slabs_.size() - written_) / slabs_for_a_sample);
}

std::optional<LayerRange> Forecast::sample_ahead() {
  const std::scoped_lock lock(mutex_);
  if (watch_.seconds() < patience_) return std::nullopt;
  while (samples_begun_ < samples_wanted()) {
    const LayerRange sample = samples_[samples_begun_++];
    if (sample.begin > slabs_[written_].begin) return sample;
    ++samples_done_;  // it was made in its turn
  }
  return std::nullopt;
}

void Forecast::add_sample(LayerRange slab, LayerCost cost) {
  const std::scoped_lock lock(mutex_);
  profile_.add(slab, cost);
  ++samples_done_;
}

void Forecast::add_written(LayerCost cost, double writing_seconds) {
  const std::scoped_lock lock(mutex_);
  ASSERT(written_ < slabs_.size());
  const LayerRange slab = slabs_[written_++];
  profile_.add(slab, cost);
  layers_written_ += slab.end - slab.begin;
  writing_seconds_ += writing_seconds;
}

std::optional<LayerCost> Forecast::left() const {
  const std::scoped_lock lock(mutex_);
  if (written_ == slabs_.size()) return LayerCost{};
  const bool is_known = written_ > 0 && samples_done_ >= std::min(least_samples, samples_wanted());
  if (!is_known || watch_.seconds() < patience_) return std::nullopt;
  // The layers that an earlier run finished may be spread thinly, or lie at one end.
  const LayerRange ahead{slabs_[written_].begin, slabs_.back().end};
  const auto count = static_cast<double>(layer_count_ - layers_written_);
  const double missing = count / static_cast<double>(ahead.end - ahead.begin);
  const LayerCost cost = profile_.of(ahead);
  const double writing = writing_seconds_ / static_cast<double>(layers_written_) * count;
  return LayerCost{wall_seconds(missing * cost.seconds, writing, threads_), missing * cost.bytes};
}

}  // namespace ombre::compile

// Forecasts the rest of a running job.
#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "base/system/stopwatch.h"
#include "jobs/common/cost_profile.h"

namespace ombre::compile {

// Returns the time that producing and writing layers take on `threads` threads; one at a time writes.
double wall_seconds(double producing, double writing, int threads);

// Learns from the slabs that are done, and from a few that are made ahead of their turn only for this purpose: at most
// one in 64, and none before `patience` seconds, since shorter jobs need no forecast. Called from several threads.
class Forecast {
 public:
  Forecast(std::vector<LayerRange> slabs, int threads, double patience = 1);

  // Returns a slab to sample now, if one is due.
  std::optional<LayerRange> sample_ahead();
  void add_sample(LayerRange slab, LayerCost cost);
  // Adds the cost of the next of the slabs, once it is written.
  void add_written(LayerCost cost, double writing_seconds);

  // Returns the remaining cost; nothing while too little is known.
  std::optional<LayerCost> left() const;

 private:
  size_t samples_wanted() const;

  mutable std::mutex mutex_;
  const std::vector<LayerRange> slabs_;
  const std::vector<LayerRange> samples_;  // in the order in which they are sampled
  const int threads_;
  const double patience_;
  const Stopwatch watch_;
  CostProfile profile_;
  size_t written_ = 0, samples_begun_ = 0, samples_done_ = 0;
  int64_t layer_count_ = 0, layers_written_ = 0;
  double writing_seconds_ = 0;
};

}  // namespace ombre::compile

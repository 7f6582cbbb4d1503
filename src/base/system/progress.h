// How long jobs report progress and are asked to stop.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "base/system/stopwatch.h"

namespace ombre {

// The progress of a job. Estimates of what is left are negative while unknown.
struct HowFar {
  uint64_t done = 0, total = 0;  // units of work
  double seconds_left = -1, bytes_left = -1;
};

// Receives progress from long work. It is called from several threads, so implementations synchronise.
class Progress {
 public:
  virtual ~Progress() = default;
  virtual void update(const HowFar& how_far) = 0;
  // Reports progress in bytes while results of earlier runs are read, before the work starts.
  virtual void checking(const HowFar&) {}
  // Reports progress while something that the work needs as a whole ("supports") is computed, before the work starts.
  virtual void preparing(const std::string& /*what*/, const HowFar&) {}
};

// A flag that a signal handler or another thread sets. Work checks it about every tenth of a second and throws
// Cancelled.
class StopFlag {
 public:
  StopFlag() = default;
  // A flag that also counts as set once `outer`, which may be null, is set or the time has passed.
  StopFlag(const StopFlag* outer, double seconds) : outer_(outer), seconds_(seconds) {}

  void request() { flag_.store(true, std::memory_order_relaxed); }
  bool requested() const {
    if (flag_.load(std::memory_order_relaxed)) return true;
    return (outer_ && outer_->requested()) || (seconds_ && watch_.seconds() > *seconds_);
  }

 private:
  std::atomic<bool> flag_{false};
  const StopFlag* outer_ = nullptr;
  std::optional<double> seconds_;
  Stopwatch watch_;
};

}  // namespace ombre

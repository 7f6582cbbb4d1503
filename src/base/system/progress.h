// How a long job reports its progress, and how it is asked to stop.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "base/system/stopwatch.h"

namespace ombre {

// How far a long job is, and what is still to come, below 0 while unknown.
struct HowFar {
  uint64_t done = 0, total = 0;  // units of work
  double seconds_left = -1, bytes_left = -1;
};

// Passed down into long work. Called from several threads; implementations synchronise.
class Progress {
 public:
  virtual ~Progress() = default;
  virtual void update(const HowFar& how_far) = 0;
  // Before the work, while what earlier runs left is read: in bytes.
  virtual void checking(const HowFar&) {}
  // Before the work, while something that it needs as a whole is computed ("supports"): in parts of it.
  virtual void preparing(const std::string& /*what*/, const HowFar&) {}
};

// Set from a signal handler or another thread; work checks it every tenth of a second or so and throws Cancelled.
class StopFlag {
 public:
  StopFlag() = default;
  // Also set once `outer` is, which may be null, or when the time is over.
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

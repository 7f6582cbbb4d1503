// How a long job tells how far it is, and how it is asked to stop.
#pragma once

#include <atomic>
#include <cstdint>

namespace ombre {

// Passed down into long work. Called from several threads; implementations synchronise.
class Progress {
 public:
  virtual ~Progress() = default;
  // `done` of `total` units of the current step are finished.
  virtual void update(uint64_t done, uint64_t total) = 0;
};

// Set from a signal handler or another thread; work checks it between slabs and throws Cancelled.
class StopFlag {
 public:
  void request() { flag_.store(true, std::memory_order_relaxed); }
  bool requested() const { return flag_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> flag_{false};
};

}  // namespace ombre

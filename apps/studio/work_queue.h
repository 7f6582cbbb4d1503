// Runs requests, a few at a time, each of which may be cancelled.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/system/progress.h"

namespace ombre::studio {

// A thread-safe queue that starts work in the order in which it came. Work that was cancelled before its start runs as
// well, with its flag set, so that it can report that. The destructor cancels all work and waits.
class WorkQueue {
 public:
  using Work = std::function<void(const StopFlag& stop)>;
  static constexpr size_t most_waiting = 256;  // for each owner

  explicit WorkQueue(int workers);
  ~WorkQueue();
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  // Adds work, and cancels the owner's work in the same lane, unless the lane is empty. Returns false, and adds
  // nothing, if too much of the owner's work waits.
  bool add(const void* owner, double id, const std::string& lane, Work work);
  void cancel(const void* owner, double id);
  void cancel_lane(const void* owner, const std::string& lane);
  void cancel_all(const void* owner);

 private:
  struct Task {
    const void* owner;
    double id;
    std::string lane;
    Work work;
    StopFlag stop = {};
  };
  using TaskPtr = std::shared_ptr<Task>;

  void run();
  template <class Chosen>
  void cancel_if(const Chosen& is_chosen);

  std::mutex mutex_;
  std::condition_variable news_;
  std::deque<TaskPtr> waiting_;
  std::list<TaskPtr> running_;
  bool is_over_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace ombre::studio

// Requests at work: a few at a time, each of which may be cancelled.
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

// Thread-safe. Work is started in the order in which it came; what was cancelled before runs as well, with its flag
// set, so that it can say so. The destructor cancels all and waits.
class WorkQueue {
 public:
  using Work = std::function<void(const StopFlag& stop)>;
  static constexpr size_t most_waiting = 256;  // of one owner

  explicit WorkQueue(int workers);
  ~WorkQueue();
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  // Cancels what the owner has in the same lane, unless that has no name. False, and nothing is added, when the owner
  // has too much waiting.
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

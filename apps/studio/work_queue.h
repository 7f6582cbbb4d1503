// A queue of requests; a few run at a time, and each may be cancelled.
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

#include "base/system/not_copied.h"
#include "base/system/progress.h"

namespace ombre::studio {

// Runs work in the order in which it was added. Work cancelled before it starts is run too, with its flag set, so that
// it can report that. The destructor cancels all work and waits for it. Thread-safe.
class WorkQueue : NotCopied {
 public:
  using Work = std::function<void(const StopFlag& stop)>;
  static constexpr size_t most_waiting = 256;  // per owner

  explicit WorkQueue(int workers);
  ~WorkQueue();

  // Adds work. It cancels the owner's other work in the same lane, unless the lane has no name. Returns false and adds
  // nothing if the owner has too much waiting work.
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

// Values that are computed ahead, before they are asked for.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/system/not_copied.h"

namespace ombre {

// Computes make(0), make(1) ... make(count - 1) in order on its own thread. At most `window` results wait to be taken.
template <class T>
class Ahead : NotCopied {
 public:
  Ahead(size_t count, size_t window, std::function<T(size_t)> make)
      : count_(count), window_(window), make_(std::move(make)), thread_([this] { work(); }) {}
  ~Ahead() {
    {
      const std::scoped_lock lock(mutex_);
      is_stopped_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  // Returns the next result; call it at most `count` times. Rethrows what `make` threw. `spent` may be an earlier
  // result: it is freed by the thread that allocated it, which is faster.
  T take(T spent = {}) {
    std::unique_lock lock(mutex_);
    spent_.push_back(std::move(spent));
    changed_.wait(lock, [this] { return failure_ || !waiting_.empty(); });
    if (waiting_.empty()) std::rethrow_exception(failure_);
    T next = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
    return next;
  }

 private:
  void work() {
    try {
      for (size_t i = 0; i < count_ && has_room(); ++i) put(make_(i));
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      failure_ = std::current_exception();
    }
    changed_.notify_all();
  }

  // Waits until there is room. Returns false when stopped.
  bool has_room() {
    std::vector<T> spent;
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_stopped_ || waiting_.size() < window_; });
    spent.swap(spent_);
    return !is_stopped_;
  }

  void put(T made) {
    {
      const std::scoped_lock lock(mutex_);
      waiting_.push_back(std::move(made));
    }
    changed_.notify_all();
  }

  const size_t count_, window_;
  const std::function<T(size_t)> make_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<T> waiting_;
  std::vector<T> spent_;
  std::exception_ptr failure_;
  bool is_stopped_ = false;
  std::thread thread_;  // last, since the thread uses the other members
};

}  // namespace ombre

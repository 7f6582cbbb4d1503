// Tasks on std::thread, for the thread sanitizer, which does not see how oneTBB synchronises and reports false races.
#ifdef OMBRE_PLAIN_THREADS

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "base/system/tasks.h"

namespace ombre {
namespace {

class OrderedRun {
 public:
  OrderedRun(size_t count, size_t window, const std::function<std::shared_ptr<void>(size_t)>& produce,
             const std::function<void(size_t, const std::shared_ptr<void>&)>& consume)
      : count_(count), window_(window), produce_(produce), consume_(consume) {}

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return failure_ || next_ == count_ || next_ - consumed_ < window_; });
      if (failure_ || next_ == count_) return;
      const size_t index = next_++;
      std::shared_ptr<void> result;
      attempt(lock, [&] { result = produce_(index); });
      ready_[index] = std::move(result);
      consume_ready(lock);
    }
  }

  void finish() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  // Calls `act` without the lock and keeps the first exception.
  template <class F>
  void attempt(std::unique_lock<std::mutex>& lock, const F& act) {
    lock.unlock();
    std::exception_ptr failure;
    try {
      act();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure && !failure_) failure_ = failure;
    changed_.notify_all();
  }

  void consume_ready(std::unique_lock<std::mutex>& lock) {
    if (is_consuming_) return;
    is_consuming_ = true;
    for (auto first = ready_.begin(); !failure_ && first != ready_.end() && first->first == consumed_;
         first = ready_.begin()) {
      const std::shared_ptr<void> result = std::move(first->second);
      ready_.erase(first);
      attempt(lock, [&] { consume_(consumed_, result); });
      ++consumed_;
      changed_.notify_all();
    }
    is_consuming_ = false;
  }

  const size_t count_, window_;
  const std::function<std::shared_ptr<void>(size_t)>& produce_;
  const std::function<void(size_t, const std::shared_ptr<void>&)>& consume_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<size_t, std::shared_ptr<void>> ready_;
  size_t next_ = 0, consumed_ = 0;
  bool is_consuming_ = false;
  std::exception_ptr failure_;
};

}  // namespace

int core_count() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

void run_ordered(size_t count, int threads, size_t window, const std::function<std::shared_ptr<void>(size_t)>& produce,
                 const std::function<void(size_t, const std::shared_ptr<void>&)>& consume) {
  OrderedRun run(count, std::max<size_t>(1, window), produce, consume);
  std::vector<std::thread> workers;
  const int worker_count = threads > 0 ? std::min(threads, core_count()) : core_count();
  for (int i = 1; i < worker_count; ++i) workers.emplace_back([&] { run.work(); });
  run.work();
  for (std::thread& worker : workers) worker.join();
  run.finish();
}

void run_parallel(size_t count, int threads, const std::function<void(size_t)>& body) {
  run_ordered(
      count, threads, count,
      [&](size_t i) {
        body(i);
        return nullptr;
      },
      [](size_t, const std::shared_ptr<void>&) {});
}

}  // namespace ombre

#endif  // OMBRE_PLAIN_THREADS

// Parallel tasks with oneTBB.
#ifndef OMBRE_PLAIN_THREADS

#include "base/system/tasks.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#include "base/system/temporary.h"

namespace ombre {

namespace {

// Never returns more threads than cores: they gain nothing, and oneTBB warns about them.
int worker_count(int threads) { return threads > 0 ? std::min(threads, core_count()) : core_count(); }

// Number of threads of the run whose task this thread executes; 0 outside tasks.
thread_local int threads_of_task = 0;

// Calls run(threads) in an arena of that many threads. Within a task of another run it shares that run's threads,
// because an arena of its own would add more. The inner run is isolated, so that a thread that waits for it does not
// take up another task of the outer run.
template <class Run>
void with_threads(int threads, Run run) {
  const int wanted = worker_count(threads);
  if (threads_of_task > 0 && threads_of_task <= wanted) {
    tbb::this_task_arena::isolate([&] { run(threads_of_task); });
    return;
  }
  tbb::task_arena arena(wanted);
  arena.execute([&] { run(wanted); });
}

}  // namespace

int core_count() { return std::max(1, tbb::info::default_concurrency()); }

void run_ordered(size_t count, int threads, size_t window, const std::function<std::shared_ptr<void>(size_t)>& produce,
                 const std::function<void(size_t, const std::shared_ptr<void>&)>& consume) {
  struct Item {
    size_t index;
    std::shared_ptr<void> result;
  };
  // Exceptions are caught here: one that passes through the pipeline would leak the items in flight.
  std::atomic<bool> failed{false};
  std::exception_ptr first_failure;
  std::mutex mutex;
  const auto guarded = [&](const auto& act) {
    if (failed) return;
    try {
      act();
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!first_failure) first_failure = std::current_exception();
      failed = true;
    }
  };
  with_threads(threads, [&](int shared) {
    size_t next = 0;
    const auto take = [&](tbb::flow_control& flow) -> Item {
      if (next < count && !failed) return {next++, nullptr};
      flow.stop();
      return {};
    };
    const auto work = [&](Item item) -> Item {
      const Temporary here(threads_of_task, shared);
      guarded([&] { item.result = produce(item.index); });
      return item;
    };
    const auto give = [&](Item item) {
      const Temporary here(threads_of_task, shared);
      guarded([&] { consume(item.index, item.result); });
    };
    tbb::parallel_pipeline(std::max<size_t>(1, window),
                           tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, take) &
                               tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, work) &
                               tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, give));
  });
  if (first_failure) std::rethrow_exception(first_failure);
}

void run_parallel(size_t count, int threads, const std::function<void(size_t)>& body) {
  // Hands out tasks one by one: the default partitioner hands out eighths, whose times may differ greatly.
  with_threads(threads, [&](int shared) {
    const auto task = [&](size_t i) {
      const Temporary here(threads_of_task, shared);
      body(i);
    };
    tbb::parallel_for(size_t{0}, count, task, tbb::simple_partitioner());
  });
}

}  // namespace ombre

#endif  // OMBRE_PLAIN_THREADS

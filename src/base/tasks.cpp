// Tasks by oneTBB.
#ifndef OMBRE_PLAIN_THREADS

#include "base/tasks.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

namespace ombre {

namespace {

// More threads than cores gain nothing, and the library would complain.
int worker_count(int threads) { return threads > 0 ? std::min(threads, core_count()) : core_count(); }

}  // namespace

int core_count() { return std::max(1, tbb::info::default_concurrency()); }

void run_ordered(size_t count, int threads, size_t window, const std::function<std::shared_ptr<void>(size_t)>& produce,
                 const std::function<void(size_t, const std::shared_ptr<void>&)>& consume) {
  struct Item {
    size_t index;
    std::shared_ptr<void> result;
  };
  // An exception that passes through the pipeline would leak the items in flight.
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
  tbb::task_arena arena(worker_count(threads));
  arena.execute([&] {
    size_t next = 0;
    const auto take = [&](tbb::flow_control& flow) -> Item {
      if (next < count && !failed) return {next++, nullptr};
      flow.stop();
      return {};
    };
    const auto work = [&](Item item) -> Item {
      guarded([&] { item.result = produce(item.index); });
      return item;
    };
    const auto give = [&](Item item) { guarded([&] { consume(item.index, item.result); }); };
    tbb::parallel_pipeline(std::max<size_t>(1, window),
                           tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, take) &
                               tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, work) &
                               tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, give));
  });
  if (first_failure) std::rethrow_exception(first_failure);
}

void run_parallel(size_t count, int threads, const std::function<void(size_t)>& body) {
  tbb::task_arena arena(worker_count(threads));
  // One by one: the partitioner of choice hands out eighths, which may take very unequal times.
  arena.execute([&] {
    tbb::parallel_for(
        size_t{0}, count, [&](size_t i) { body(i); }, tbb::simple_partitioner());
  });
}

}  // namespace ombre

#endif  // OMBRE_PLAIN_THREADS

#include "base/tasks.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace ombre {

int core_count() { return std::max(1, tbb::info::default_concurrency()); }

void run_ordered(size_t count, int threads, size_t window, const std::function<std::shared_ptr<void>(size_t)>& produce,
                 const std::function<void(size_t, std::shared_ptr<void>)>& consume) {
  struct Item {
    size_t index;
    std::shared_ptr<void> result;
  };
  tbb::task_arena arena(threads > 0 ? threads : core_count());
  arena.execute([&] {
    size_t next = 0;
    const auto take = [&](tbb::flow_control& flow) -> Item {
      if (next < count) return {next++, nullptr};
      flow.stop();
      return {};
    };
    const auto work = [&](Item item) -> Item { return {item.index, produce(item.index)}; };
    const auto give = [&](Item item) { consume(item.index, std::move(item.result)); };
    tbb::parallel_pipeline(std::max<size_t>(1, window), tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, take) &
                                       tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, work) &
                                       tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, give));
  });
}

void run_parallel(size_t count, int threads, const std::function<void(size_t)>& body) {
  tbb::task_arena arena(threads > 0 ? threads : core_count());
  arena.execute([&] { tbb::parallel_for(size_t{0}, count, [&](size_t i) { body(i); }); });
}

}  // namespace ombre

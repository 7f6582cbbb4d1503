// Parallel work whose results are ordered.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace ombre {

// Runs produce(i) for 0 <= i < count on up to `threads` threads and passes each result to consume(i, result) in order,
// one at a time. At most `window` results exist at once. The first exception stops the rest and is rethrown. `threads`
// 0 means all cores. A run within a task of another run shares its threads.
void run_ordered(size_t count, int threads, size_t window, const std::function<std::shared_ptr<void>(size_t)>& produce,
                 const std::function<void(size_t, const std::shared_ptr<void>&)>& consume);

template <class T>
void run_ordered(size_t count, int threads, size_t window, const std::function<T(size_t)>& produce,
                 const std::function<void(size_t, T&)>& consume) {
  run_ordered(
      count, threads, window, [&](size_t i) { return std::static_pointer_cast<void>(std::make_shared<T>(produce(i))); },
      [&](size_t i, const std::shared_ptr<void>& result) { consume(i, *static_cast<T*>(result.get())); });
}

// Runs body(i) for all i < count in no particular order.
void run_parallel(size_t count, int threads, const std::function<void(size_t)>& body);

int core_count();

}  // namespace ombre

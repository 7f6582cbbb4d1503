// Tests of order, window and failures. Test names are chosen so that a filter can select them for the thread sanitizer.
#include "base/system/tasks.h"

#include <gtest/gtest.h>
#ifndef OMBRE_PLAIN_THREADS
#include <tbb/global_control.h>
#endif

#include <atomic>
#include <chrono>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace ombre {
namespace {

struct Case {
  size_t count;
  int threads;
  size_t window;
};

const Case cases[] = {{0, 4, 3},   {1, 1, 1},    {1, 8, 100},  {100, 1, 1},   {100, 1, 16}, {200, 4, 1},   {200, 4, 2},
                      {300, 4, 5}, {300, 2, 64}, {300, 16, 3}, {1000, 0, 32}, {50, 3, 0},   {50, 3, 10000}};

// Sleeps for varying times, so that results finish out of order.
void work(size_t i) { std::this_thread::sleep_for(std::chrono::microseconds((i * 2654435761u) % 97)); }

void raise_to(int value, std::atomic<int>& most) {
  for (int before = most; value > before && !most.compare_exchange_weak(before, value);) {
  }
}

// Counts its living instances.
struct Counted {
  std::atomic<int>* alive;
  size_t index;
  Counted(std::atomic<int>& counter, size_t i) : alive(&counter), index(i) { ++*alive; }
  Counted(const Counted& other) : alive(other.alive), index(other.index) { ++*alive; }
  Counted& operator=(const Counted&) = delete;
  ~Counted() { --*alive; }
};

}  // namespace

TEST(Ordered, ResultsComeInOrder) {
  for (const Case& c : cases) {
    std::vector<size_t> seen;
    run_ordered<size_t>(
        c.count, c.threads, c.window,
        [](size_t i) {
          work(i);
          return i * i;
        },
        [&](size_t i, size_t& square) {
          EXPECT_EQ(square, i * i);
          seen.push_back(i);
        });
    ASSERT_EQ(seen.size(), c.count);
    for (size_t i = 0; i < c.count; ++i) EXPECT_EQ(seen[i], i);
  }
}

TEST(Ordered, TheWindowBoundsWhatLives) {
  for (const Case& c : cases) {
    std::atomic<int> alive{0}, most{0};
    const auto produce = [&](size_t i) {
      auto result = std::make_shared<Counted>(alive, i);
      raise_to(alive, most);
      work(i);
      return std::static_pointer_cast<void>(result);
    };
    run_ordered(c.count, c.threads, c.window, produce, [&](size_t i, const std::shared_ptr<void>& result) {
      EXPECT_EQ(static_cast<Counted*>(result.get())->index, i);
      // The first result is consumed slowly, so the others must wait.
      if (i == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    });
    EXPECT_LE(most, static_cast<int>(std::max<size_t>(1, c.window)));
    EXPECT_EQ(alive, 0);
  }
}

TEST(Ordered, AFailureStopsTheRestAndIsThrownAgain) {
  for (const Case& c : cases) {
    for (const size_t bad : {size_t{0}, c.count / 2, c.count - 1}) {
      if (c.count == 0) continue;
      for (const bool in_produce : {true, false}) {
        std::atomic<int> alive{0};
        std::atomic<size_t> produced{0};
        size_t consumed = 0;
        const auto run = [&] {
          run_ordered(
              c.count, c.threads, c.window,
              [&](size_t i) {
                ++produced;
                work(i);
                if (in_produce && i == bad) throw std::runtime_error("at " + std::to_string(i));
                return std::static_pointer_cast<void>(std::make_shared<Counted>(alive, i));
              },
              [&](size_t i, const std::shared_ptr<void>& result) {
                ASSERT_TRUE(result);
                EXPECT_EQ(i, consumed);  // consumed indices have no gaps
                if (!in_produce && i == bad) throw std::runtime_error("at " + std::to_string(i));
                ++consumed;
              });
        };
        try {
          run();
          ADD_FAILURE() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
          EXPECT_EQ(error.what(), "at " + std::to_string(bad));
        }
        EXPECT_EQ(alive, 0);
        EXPECT_LE(consumed, bad);
        EXPECT_LE(produced, bad + std::max<size_t>(1, c.window));
      }
    }
  }
}

TEST(Ordered, ManyFailuresThrowOne) {
  EXPECT_THROW(run_ordered<int>(
                   100, 8, 16, [](size_t) -> int { throw std::runtime_error("all"); }, [](size_t, int&) {}),
               std::runtime_error);
}

TEST(Ordered, RunsInsideRuns) {
  std::atomic<size_t> sum{0};
  run_ordered<size_t>(
      20, 4, 4,
      [](size_t i) {
        std::atomic<size_t> inner{0};
        run_parallel(i, 2, [&](size_t k) { inner += k; });
        return inner.load();
      },
      [&](size_t, size_t& part) { sum += part; });
  size_t expected = 0;
  for (size_t i = 0; i < 20; ++i) expected += i * (i - 1) / 2;
  EXPECT_EQ(sum, expected);
}

TEST(Threads, EveryIndexOnce) {
  for (const int threads : {0, 1, 2, 7, 64}) {
    for (const size_t count : {0, 1, 5, 10000}) {
      std::vector<std::atomic<int>> times(count);
      run_parallel(count, threads, [&](size_t i) { ++times[i]; });
      for (const auto& n : times) EXPECT_EQ(n, 1);
    }
  }
}

TEST(Threads, NeverMoreThanRequested) {
  for (const int threads : {1, 2, 3}) {
    std::atomic<int> now{0}, most{0};
    run_parallel(200, threads, [&](size_t i) {
      raise_to(++now, most);
      work(i);
      --now;
    });
    EXPECT_LE(most, threads);
  }
}

#ifndef OMBRE_PLAIN_THREADS
// This test needs cores for the threads of each inner run as well.
TEST(Threads, RunsWithinTasksShareThem) {
  if (core_count() < 2) GTEST_SKIP();
  const tbb::global_control enough(tbb::global_control::max_allowed_parallelism, 8);
  std::atomic<int> now{0}, most{0}, runs{0};
  run_parallel(2, 2, [&](size_t) {
    run_parallel(100, 2, [&](size_t) {
      raise_to(++now, most);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      --now;
      ++runs;
    });
  });
  EXPECT_EQ(runs, 200);
  EXPECT_LE(most, 2);
}

// An inner run that asks for fewer threads gets fewer.
TEST(Threads, ARunWithinATaskHasNoMoreThanItAsksFor) {
  run_parallel(2, 0, [](size_t) {
    std::atomic<int> now{0};
    run_parallel(50, 1, [&](size_t) {
      EXPECT_EQ(++now, 1);
      --now;
    });
  });
}
#endif

TEST(Threads, AFailureIsThrownAgain) {
  for (const int threads : {1, 4})
    EXPECT_THROW(run_parallel(100, threads,
                              [](size_t i) {
                                if (i == 37) throw std::runtime_error("37");
                              }),
                 std::runtime_error);
  EXPECT_GE(core_count(), 1);
}

}  // namespace ombre

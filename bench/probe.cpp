// How fast this machine runs two loops that nothing of ours can slow down, on one thread and on two.
// Two virtual cores may share a physical one for minutes; figures taken then say nothing about scaling.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Hash and compare: what picking one of two materials takes at least.
uint32_t pick_voxels(uint32_t seed, uint32_t count) {
  uint32_t picked = 0;
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t h = seed + i * 0xC2B2AE35u;
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    picked += h < seed ? 1u : 0u;
  }
  return picked;
}

// The least of several times, in seconds, that all of the threads take to run `work(thread)` side by side.
template <class Work>
double best_time(int threads, Work work) {
  double best = 1e9;
  for (int repetition = 0; repetition < 5; ++repetition) {
    const double began = now();
    std::vector<std::thread> running;
    for (int t = 0; t < threads; ++t) running.emplace_back([&, t] { work(t); });
    for (std::thread& thread : running) thread.join();
    best = std::min(best, now() - began);
  }
  return best;
}

// Billions a second over all threads.
double picks(int threads) {
  constexpr uint32_t count = 1u << 26;
  std::vector<uint32_t> sinks(static_cast<size_t>(threads) * 64);
  const double seconds = best_time(threads, [&](int t) {
    volatile uint32_t seed = 0x80000000u + static_cast<uint32_t>(t);
    sinks[static_cast<size_t>(t) * 64] = pick_voxels(seed, count);
  });
  return threads * static_cast<double>(count) / seconds / 1e9;
}

// Gigabytes a second over all threads.
double fills(int threads) {
  constexpr size_t bytes = size_t{1} << 28;
  std::vector<std::vector<uint8_t>> blocks(static_cast<size_t>(threads), std::vector<uint8_t>(bytes));
  const double seconds = best_time(threads, [&](int t) {
    volatile int value = t + 1;
    std::memset(blocks[static_cast<size_t>(t)].data(), value, bytes);
  });
  return threads * static_cast<double>(bytes) / seconds / 1e9;
}

}  // namespace

int main() { std::printf("{\"picks\":[%.3f,%.3f],\"fills\":[%.3f,%.3f]}\n", picks(1), picks(2), fills(1), fills(2)); }

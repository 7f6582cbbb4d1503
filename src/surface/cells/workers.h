// The threads that work on a surface, and their stop flag.
#pragma once

#include <cstddef>

#include "base/system/progress.h"
#include "base/system/tasks.h"
#include "base/text/error.h"

namespace ombre::surface {

struct Workers {
  int threads = 0;                 // 0: all cores
  const StopFlag* stop = nullptr;  // may be null

  // Throws Cancelled if a stop is requested. Long work calls it at least every few hundredths of a second.
  void check_stop() const {
    if (stop && stop->requested()) throw Cancelled();
  }
  // Calls check_stop() every 4096th turn of a long loop.
  void check_stop_at(size_t turn) const {
    if (turn % turns_between_checks == 0) check_stop();
  }

  // Calls body(begin, end) in parallel for consecutive pieces of 0 to count, in no particular order. Throws Cancelled.
  template <class Body>
  void in_pieces(size_t count, size_t piece, const Body& body) const {
    run_parallel((count + piece - 1) / piece, threads, [&](size_t p) {
      check_stop();
      body(p * piece, p + 1 < (count + piece - 1) / piece ? (p + 1) * piece : count);
    });
  }

 private:
  static constexpr size_t turns_between_checks = 4096;
};

}  // namespace ombre::surface

// Threads that work on a surface until they are done, or are to stop.
#pragma once

#include <cstddef>

#include "base/system/progress.h"
#include "base/system/tasks.h"
#include "base/text/error.h"

namespace ombre::surface {

struct Workers {
  int threads = 0;                 // 0: all cores
  const StopFlag* stop = nullptr;  // may be null

  // Throws Cancelled once the work is to stop. Call it at least every few hundredths of a second.
  void check_stop() const {
    if (stop && stop->requested()) throw Cancelled();
  }
  // The same in a long loop, at each so many turns.
  void check_stop_at(size_t turn) const {
    if (turn % turns_between_checks == 0) check_stop();
  }

  // body(begin, end) for pieces of 0 to count, in no particular order. Throws Cancelled.
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

// Progress of jobs whose units of work take about the same time each.
#pragma once

#include "base/system/progress.h"

namespace ombre {

// Returns the progress after `seconds` of work, with an estimate of the seconds left.
inline HowFar at_steady_pace(uint64_t done, uint64_t total, double seconds) {
  HowFar how{done, total};
  if (done > 0) how.seconds_left = seconds * static_cast<double>(total - done) / static_cast<double>(done);
  return how;
}

}  // namespace ombre

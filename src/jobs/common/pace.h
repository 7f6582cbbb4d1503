// Measures the pace of work, and reports it now and then.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "base/system/progress.h"
#include "jobs/common/events.h"

namespace ombre::jobs {

// Progress and speed of a job.
struct Pace {
  double share = 0;              // share of the work, 0 ... 1
  double voxels_per_second = 0;  // 0 while unknown
  double seconds_left = -1;      // below 0 while unknown
  bool is_checking = false;      // existing work is being checked
  std::string preparing = {};    // name of a preparation that is being computed
};

std::string duration_text(double seconds);  // "0:34", "1:02:03"
std::string rate_text(double voxels_per_second);

// Measures the pace of work. If less is done than before, other work has begun, and its pace is measured. Each method
// returns the pace when it is time to report it. Thread-safe.
class PaceMeter {
 public:
  PaceMeter(Counted counted, double interval_s) : counted_(counted), interval_s_(interval_s) {}

  std::optional<Pace> update(const HowFar& how_far);
  std::optional<Pace> checking(const HowFar& how_far);
  std::optional<Pace> preparing(const std::string& what, const HowFar& how_far);

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due();
  bool is_due_before_work();

  Counted counted_;
  double interval_s_;
  std::mutex mutex_;
  bool started_ = false, has_begun_ = false;
  uint64_t done_at_start_ = 0, most_done_ = 0;
  Clock::time_point start_, reported_;
};

}  // namespace ombre::jobs

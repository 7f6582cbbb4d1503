// Progress of a long job: a bar on a terminal, a line now and then elsewhere, or events.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "base/system/progress.h"
#include "ombre/console.h"

namespace ombre::cli {

// How far a job is, and how fast.
struct Pace {
  double share = 0;              // of the work, 0 ... 1
  double voxels_per_second = 0;  // 0 while unknown
  double seconds_left = -1;      // below 0 while unknown
  bool is_checking = false;      // what is there already
  std::string preparing = {};    // what the job needs before its work, if it is computed now
};

// "[=====>    ]  45%  123 M voxels/s  0:34 left"
std::string progress_bar(const Pace& pace);
std::string progress_text(const Pace& pace);  // the same without the bar
std::string duration_text(double seconds);    // "0:34", "1:02:03"
std::string rate_text(double voxels_per_second);

// What a job counts: of steps, which may take unequal times, no rate is said.
enum class Counted { voxels, steps };

class ProgressLine : public Progress {
 public:
  explicit ProgressLine(const Console& console, Counted counted = Counted::voxels)
      : console_(console), counted_(counted) {}
  ~ProgressLine() override { finish(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void update(const HowFar& how_far) override;
  void checking(const HowFar& how_far) override;
  void preparing(const std::string& what, const HowFar& how_far) override;
  // Clears the bar, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due();
  bool is_due_before_work();
  void show(const Pace& pace);
  void tell_programs(const HowFar& how_far, const Pace& pace) const;

  const Console& console_;
  Counted counted_;
  std::mutex mutex_;
  bool started_ = false, has_begun_ = false, bar_shown_ = false;
  uint64_t done_at_start_ = 0;
  Clock::time_point start_, shown_;
};

}  // namespace ombre::cli

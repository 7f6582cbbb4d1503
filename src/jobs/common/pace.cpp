#include "jobs/common/pace.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::jobs {
namespace {

std::string two_digits(int64_t value) { return (value < 10 ? "0" : "") + std::to_string(value); }

Pace pace_of(const HowFar& how_far) {
  Pace pace;
  const auto done = static_cast<double>(how_far.done), total = static_cast<double>(how_far.total);
  pace.share = total > 0 ? done / total : 1;
  pace.seconds_left = how_far.seconds_left;
  return pace;
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<int64_t>(std::llround(std::clamp(seconds, 0.0, 1e9)));
  const int64_t hours = whole / 3600, minutes = whole / 60 % 60;
  if (hours == 0) return std::to_string(minutes) + ':' + two_digits(whole % 60);
  return std::to_string(hours) + ':' + two_digits(minutes) + ':' + two_digits(whole % 60);
}

std::string rate_text(double voxels_per_second) {
  for (const auto& [unit, prefix] : {std::pair{1e9, "G"}, std::pair{1e6, "M"}, std::pair{1e3, "k"}})
    if (voxels_per_second >= unit) return format_rounded(voxels_per_second / unit, 3) + ' ' + prefix + " voxels/s";
  return format_rounded(voxels_per_second, 3) + " voxels/s";
}

std::optional<Pace> PaceMeter::update(const HowFar& how_far) {
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  // Threads may report a little out of order; a fall by half is the beginning of other work.
  const bool begins = !started_ || how_far.done < most_done_ / 2;
  most_done_ = begins ? how_far.done : std::max(most_done_, how_far.done);
  if (begins) {
    started_ = true;
    start_ = reported_ = now;
    done_at_start_ = how_far.done;  // work of an earlier run tells nothing about the pace of this one
    return std::nullopt;
  }
  if (!is_due()) return std::nullopt;
  Pace pace = pace_of(how_far);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (elapsed > 0 && counted_ == Counted::voxels && how_far.done > done_at_start_)
    pace.voxels_per_second = static_cast<double>(how_far.done - done_at_start_) / elapsed;
  return pace;
}

std::optional<Pace> PaceMeter::checking(const HowFar& how_far) {
  const std::scoped_lock lock(mutex_);
  if (!is_due_before_work()) return std::nullopt;
  Pace pace = pace_of(how_far);
  pace.is_checking = true;
  return pace;
}

std::optional<Pace> PaceMeter::preparing(const std::string& what, const HowFar& how_far) {
  const std::scoped_lock lock(mutex_);
  if (!is_due_before_work()) return std::nullopt;
  Pace pace = pace_of(how_far);
  pace.preparing = what;
  return pace;
}

bool PaceMeter::is_due_before_work() {
  if (!has_begun_) reported_ = Clock::now();
  has_begun_ = true;
  return is_due();
}

// True at most a few times a second.
bool PaceMeter::is_due() {
  const auto now = Clock::now();
  if (std::chrono::duration<double>(now - reported_).count() < interval_s_) return false;
  reported_ = now;
  return true;
}

}  // namespace ombre::jobs

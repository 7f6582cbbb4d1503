// Progress of a long job: a bar on a terminal, a line now and then elsewhere, or events.
#include "ombre/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text/text.h"

namespace ombre::cli {
namespace {

constexpr int bar_width = 30;
constexpr double bar_interval_s = 0.1, event_interval_s = 1, line_interval_s = 10;

std::string two_digits(int64_t value) { return (value < 10 ? "0" : "") + std::to_string(value); }

std::string percent(double share) {
  const std::string text = std::to_string(static_cast<int>(std::floor(std::clamp(share, 0.0, 1.0) * 100)));
  return std::string(3 - std::min<size_t>(3, text.size()), ' ') + text + '%';
}

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

std::string progress_text(const Pace& pace) {
  std::string text = percent(pace.share);
  if (pace.is_checking) text += "  checking what is there";
  if (!pace.preparing.empty()) text += "  " + pace.preparing;
  if (pace.voxels_per_second > 0) text += "  " + rate_text(pace.voxels_per_second);
  if (pace.seconds_left >= 0) text += "  " + duration_text(pace.seconds_left) + " left";
  return text;
}

std::string progress_bar(const Pace& pace) {
  const int filled = static_cast<int>(std::clamp(pace.share, 0.0, 1.0) * bar_width);
  std::string bar(static_cast<size_t>(filled), '=');
  if (filled < bar_width) bar += '>' + std::string(static_cast<size_t>(bar_width - filled - 1), ' ');
  return '[' + bar + "] " + progress_text(pace);
}

void ProgressLine::update(const HowFar& how_far) {
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  if (!started_) {
    started_ = true;
    start_ = shown_ = now;
    done_at_start_ = how_far.done;  // what an earlier run finished tells nothing about the pace of this one
    return;
  }
  if (!is_due()) return;
  Pace pace = pace_of(how_far);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (elapsed > 0 && counted_ == Counted::voxels)
    pace.voxels_per_second = static_cast<double>(how_far.done - done_at_start_) / elapsed;
  show(pace);
  if (console_.voice() == Voice::programs) tell_programs(how_far, pace);
}

void ProgressLine::tell_programs(const HowFar& how_far, const Pace& pace) const {
  const auto done = static_cast<double>(how_far.done), total = static_cast<double>(how_far.total);
  const double seconds_left = std::round(pace.seconds_left);
  if (counted_ == Counted::steps)
    return console_.event("progress", {{"steps_done", done}, {"steps_total", total}, {"seconds_left", seconds_left}});
  console_.event("progress", {{"voxels_done", done},
                              {"voxels_total", total},
                              {"voxels_per_second", std::round(pace.voxels_per_second)},
                              {"seconds_left", seconds_left}});
}

void ProgressLine::checking(const HowFar& how_far) {
  const std::scoped_lock lock(mutex_);
  if (!is_due_before_work()) return;
  Pace pace = pace_of(how_far);
  pace.is_checking = true;
  show(pace);
  if (console_.voice() == Voice::programs)
    console_.event("checking", {{"bytes_done", static_cast<double>(how_far.done)},
                                {"bytes_total", static_cast<double>(how_far.total)},
                                {"seconds_left", std::round(pace.seconds_left)}});
}

void ProgressLine::preparing(const std::string& what, const HowFar& how_far) {
  const std::scoped_lock lock(mutex_);
  if (!is_due_before_work()) return;
  Pace pace = pace_of(how_far);
  pace.preparing = what;
  show(pace);
  if (console_.voice() == Voice::programs)
    console_.event("preparing",
                   {{"what", what}, {"share", pace.share}, {"seconds_left", std::round(pace.seconds_left)}});
}

bool ProgressLine::is_due_before_work() {
  if (!has_begun_) shown_ = Clock::now();
  has_begun_ = true;
  return is_due();
}

// Not more often than anyone wants to know.
bool ProgressLine::is_due() {
  const double interval = console_.voice() == Voice::programs ? event_interval_s
                          : console_.is_terminal()            ? bar_interval_s
                                                              : line_interval_s;
  const auto now = Clock::now();
  if (std::chrono::duration<double>(now - shown_).count() < interval) return false;
  shown_ = now;
  return true;
}

void ProgressLine::show(const Pace& pace) {
  if (console_.voice() != Voice::people) return;
  if (!console_.is_terminal()) return console_.say(std::string(trim(progress_text(pace))));
  std::fputs(("\r\033[K" + progress_bar(pace)).c_str(), stderr);
  std::fflush(stderr);
  bar_shown_ = true;
}

void ProgressLine::finish() {
  const std::scoped_lock lock(mutex_);
  if (!bar_shown_) return;
  bar_shown_ = false;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

}  // namespace ombre::cli

// Shows the progress of a long job: a bar on a terminal, a line now and then elsewhere, or events.
#include "ombre/progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text/text.h"

namespace ombre::cli {

using jobs::duration_text;
using jobs::Pace;
using jobs::rate_text;

namespace {

constexpr int bar_width = 30;
constexpr double bar_interval_s = 0.1, line_interval_s = 10;

std::string percent(double share) {
  const std::string text = std::to_string(static_cast<int>(std::floor(std::clamp(share, 0.0, 1.0) * 100)));
  return std::string(3 - std::min<size_t>(3, text.size()), ' ') + text + '%';
}

}  // namespace

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

ProgressLine::ProgressLine(bool is_terminal, jobs::Counted counted)
    : is_terminal_(is_terminal), meter_(counted, is_terminal ? bar_interval_s : line_interval_s) {}

void ProgressLine::show(const std::optional<Pace>& pace) {
  if (!pace) return;
  const std::scoped_lock lock(mutex_);
  const std::string shown =
      is_terminal_ ? "\r\033[K" + progress_bar(*pace) : std::string(trim(progress_text(*pace))) + '\n';
  std::fputs(shown.c_str(), stderr);
  std::fflush(stderr);
  bar_shown_ = is_terminal_;
}

void ProgressLine::clear() {
  const std::scoped_lock lock(mutex_);
  if (!bar_shown_) return;
  bar_shown_ = false;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

}  // namespace ombre::cli

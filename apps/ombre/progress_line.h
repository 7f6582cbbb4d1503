// Shows the progress of a long job to people: a bar on a terminal, a line now and then elsewhere.
#pragma once

#include <mutex>
#include <string>

#include "base/system/not_copied.h"
#include "jobs/common/pace.h"

namespace ombre::cli {

// Returns a bar such as "[=====>    ]  45%  123 M voxels/s  0:34 left".
std::string progress_bar(const jobs::Pace& pace);
std::string progress_text(const jobs::Pace& pace);  // returns the text without the bar

class ProgressLine final : public jobs::ShownProgress, NotCopied {
 public:
  // Prints lines, unless stderr is a terminal on which a bar can be redrawn.
  ProgressLine(bool is_terminal, jobs::Counted counted);
  ~ProgressLine() override { clear(); }

  void update(const HowFar& how_far) override { show(meter_.update(how_far)); }
  void checking(const HowFar& how_far) override { show(meter_.checking(how_far)); }
  void preparing(const std::string& what, const HowFar& how_far) override { show(meter_.preparing(what, how_far)); }
  void finish() override { clear(); }

 private:
  void show(const std::optional<jobs::Pace>& pace);
  void clear();

  bool is_terminal_;
  jobs::PaceMeter meter_;
  std::mutex mutex_;
  bool bar_shown_ = false;
};

}  // namespace ombre::cli

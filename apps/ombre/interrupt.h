// Ctrl-C: the first asks a job to stop where it can be resumed, the second ends the program.
#pragma once

#include "base/system/progress.h"

namespace ombre::cli {

// While one exists, SIGINT and SIGTERM set its flag. At most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const StopFlag& flag() const { return flag_; }

 private:
  StopFlag flag_;
  void (*interrupt_before_)(int);
  void (*terminate_before_)(int);
};

// While one exists, the first signal ends the program at once: nothing has been written yet, and what is under way, in
// libraries of others, cannot be asked to stop.
class QuitAtOnce {
 public:
  QuitAtOnce();
  ~QuitAtOnce();
  QuitAtOnce(const QuitAtOnce&) = delete;
  QuitAtOnce& operator=(const QuitAtOnce&) = delete;
};

}  // namespace ombre::cli

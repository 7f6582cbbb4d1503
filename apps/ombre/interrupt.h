// Handles Ctrl-C: the first asks a job to stop where it can be resumed, the second ends the program.
#pragma once

#include "base/system/not_copied.h"
#include "base/system/progress.h"

namespace ombre::cli {

// A guard under which SIGINT and SIGTERM set its flag. At most one may exist at a time.
class InterruptGuard : NotCopied {
 public:
  InterruptGuard();
  ~InterruptGuard();

  const StopFlag& flag() const { return flag_; }

 private:
  StopFlag flag_;
  void (*interrupt_before_)(int);
  void (*terminate_before_)(int);
};

// A guard under which the first signal ends the program at once. It is for times when nothing has been written yet, and
// work in other libraries cannot be asked to stop.
class QuitAtOnce : NotCopied {
 public:
  QuitAtOnce();
  ~QuitAtOnce();
};

}  // namespace ombre::cli

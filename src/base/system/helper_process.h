// Work in a separate process with limits of time and memory, for libraries that files can crash or hang, or that cannot
// be stopped.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "base/system/progress.h"
#include "base/text/error.h"

namespace ombre {

struct HelperLimits {
  // Processor time of the child and of the processes that it has waited for, so that a busy machine does not make work
  // fail. A child that waits without working ends after `clock_factor` times as many seconds of the clock.
  double seconds = 60;
  size_t memory_bytes = size_t{4} << 30;  // beyond what the process holds at the start; 0 means no limit

  static constexpr double clock_factor = 20;
};

enum class HelperFailure { crashed, too_slow };

using HelperExplain = std::function<Error(HelperFailure)>;

// Runs `work` in a child process and returns its result. Changes that `work` makes in memory are lost, and it must not
// use other threads. An Error that it throws is rethrown here with its code and values; if memory runs out, it may
// handle std::bad_alloc. If the child crashes or takes too long, throws the Error that `explain` makes. Throws
// Cancelled if `stop`, which may be null, is set or Ctrl-C ends the child.
std::string run_in_helper(const std::function<std::string()>& work, const HelperLimits& limits,
                          const HelperExplain& explain, const StopFlag* stop);

// A child process that answers one request after another and keeps its memory between them. The thread that creates it
// must outlive it.
class Helper {
 public:
  // `answer` runs in the child. The limits of time apply to each request, the limit of memory to the child.
  Helper(std::function<std::string(const std::string& request)> answer, const HelperLimits& limits,
         HelperExplain explain);
  // Kills the child if it still runs.
  ~Helper();

  // Returns the child's answer. Throws what run_in_helper() throws; then the child is gone, unless `answer` threw an
  // Error. `waiting`, which may be empty, is called about every 50 ms until the answer comes.
  std::string ask(const std::string& request, const StopFlag* stop, const std::function<void()>& waiting = {});

 private:
  class Child;

  HelperLimits limits_;
  HelperExplain explain_;
  std::unique_ptr<Child> child_;
};

}  // namespace ombre

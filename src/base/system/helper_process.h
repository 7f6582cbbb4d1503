// Work in a process of its own, with limits of time and memory: for libraries that files can crash or hang, or that
// cannot be stopped.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "base/system/progress.h"
#include "base/text/error.h"

namespace ombre {

struct HelperLimits {
  double seconds = 60;
  size_t memory_bytes = size_t{4} << 30;  // beyond what the program holds already; 0: no limit
};

enum class HelperFailure { crashed, too_slow };

using HelperExplain = std::function<Error(HelperFailure)>;

// Runs `work` in a child process and returns what it returned. What `work` changes in memory is lost; it must not use
// other threads. An Error that it throws is thrown here with its code and values; where it runs out of memory,
// std::bad_alloc is its to handle. When the child crashes or exceeds its time, throws the Error that `explain` makes.
// Throws Cancelled when `stop`, which may be null, is set, or Ctrl-C ends the child.
std::string run_in_helper(const std::function<std::string()>& work, const HelperLimits& limits,
                          const HelperExplain& explain, const StopFlag* stop);

// A child process that answers one request after another, and keeps its memory from one to the next. The thread that
// makes it must outlive it.
class Helper {
 public:
  // `answer` runs in the child. `limits` are of each request alone, where they are of time.
  Helper(std::function<std::string(const std::string& request)> answer, const HelperLimits& limits,
         HelperExplain explain);
  // Kills the child.
  ~Helper();

  // Throws what run_in_helper() throws; then there is no child any more, unless `answer` threw an Error. `waiting`,
  // which may be empty, is called about every 50 ms until the answer comes.
  std::string ask(const std::string& request, const StopFlag* stop, const std::function<void()>& waiting = {});

 private:
  class Child;

  HelperLimits limits_;
  HelperExplain explain_;
  std::unique_ptr<Child> child_;
};

}  // namespace ombre

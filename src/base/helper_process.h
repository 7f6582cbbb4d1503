// Work in a process of its own, with limits of time and memory: for libraries that files can crash or hang.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "base/error.h"
#include "base/progress.h"

namespace ombre {

struct HelperLimits {
  double seconds = 60;
  size_t memory_bytes = size_t{4} << 30;  // beyond what the program holds already
};

enum class HelperFailure { crashed, too_slow };

// Runs `work` in a child process and returns what it returned. What `work` changes in memory is lost; it must not use
// other threads. An Error that it throws is thrown here with its code and values; where it runs out of memory,
// std::bad_alloc is its to handle. When the child crashes or exceeds its time, throws the Error that `explain` makes.
// Throws Cancelled when `stop`, which may be null, is set, or Ctrl-C ends the child.
std::string run_in_helper(const std::function<std::string()>& work, const HelperLimits& limits,
                          const std::function<Error(HelperFailure)>& explain, const StopFlag* stop);

}  // namespace ombre

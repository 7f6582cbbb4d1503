// Programs of others that this one starts and waits for.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/system/progress.h"

namespace ombre {

struct OtherProgram {
  std::vector<std::string> command;  // the program, which is sought on the path, and its arguments
  std::string folder;                // where it works; empty for the folder of this process
  std::string log;                   // the file that gets what it says; empty for the streams of this process
  std::vector<std::pair<std::string, std::string>> variables;  // of its environment, beside those of this process
  int stop_signal;                                             // what it and its children get when it is to stop

  // Runs it, without input, to its end. Returns its status, as of waitpid(); nothing if there is no such program.
  // Throws Error if it cannot be started, and Cancelled, once it has ended, if `stop`, which may be null, is set.
  std::optional<int> run(const StopFlag* stop) const;
};

}  // namespace ombre

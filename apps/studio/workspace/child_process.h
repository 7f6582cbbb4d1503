// Programs that the studio starts.
#pragma once

#include <string>
#include <vector>

#include "base/system/progress.h"

namespace ombre::studio {

// Starts a program, such as the browser, without waiting for it. It does not inherit files or sockets. Returns false if
// it cannot start.
bool start_program(const std::vector<std::string>& command);

struct ProgramOutput {
  int status = 0;  // exit status; -1 if a signal ended it
  std::string out, err;
};

// Runs a program and waits for it. Kills it, with all its child processes, if a stop is requested or its output exceeds
// `most_bytes`. Throws Cancelled, and Error if it cannot start or its output is too long.
ProgramOutput run_program(const std::vector<std::string>& command, const StopFlag& stop, size_t most_bytes);

}  // namespace ombre::studio

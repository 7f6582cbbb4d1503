// Programs that the studio starts.
#pragma once

#include <string>
#include <vector>

#include "base/system/progress.h"

namespace ombre::studio {

// Starts a program for which nobody waits, such as the browser. It gets none of this program's files and sockets.
// Returns false when it cannot start.
bool start_program(const std::vector<std::string>& command);

struct ProgramOutput {
  int status = 0;  // exit status; -1 when a signal ended it
  std::string out, err;
};

// Runs a program and waits for it. Ends it with all programs that it started if it is asked to stop, or if the output
// exceeds `most_bytes`. Throws Cancelled, and Error when it cannot start or writes too much.
ProgramOutput run_program(const std::vector<std::string>& command, const StopFlag& stop, size_t most_bytes);

}  // namespace ombre::studio

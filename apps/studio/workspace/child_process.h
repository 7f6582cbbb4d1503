// Programs that the studio starts.
#pragma once

#include <string>
#include <vector>

#include "base/system/progress.h"

namespace ombre::studio {

// The browser, say: nobody waits for it. It gets none of this program's files and sockets. False when it cannot start.
bool start_program(const std::vector<std::string>& command);

struct ProgramOutput {
  int status = 0;  // of its end; -1 when a signal ended it
  std::string out, err;
};

// Waits for it, and ends it with all that it started when it is asked to stop or says more than `most_bytes`. Throws
// Cancelled, and Error when it cannot start or says too much.
ProgramOutput run_program(const std::vector<std::string>& command, const StopFlag& stop, size_t most_bytes);

}  // namespace ombre::studio

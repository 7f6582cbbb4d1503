// Programs that the studio starts.
#pragma once

#include <functional>
#include <string>
#include <string_view>
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

// Runs a program and waits for it. `said` gets what it writes to stderr at once, piece by piece; `err` then keeps only
// the end of it. The program, with all its child processes, is killed if a stop is requested, if its output exceeds
// `most_bytes`, and when this program ends, also by a signal. Throws Cancelled, and Error if it cannot start or its
// output is too long.
ProgramOutput run_program(const std::vector<std::string>& command, const StopFlag& stop, size_t most_bytes,
                          const std::function<void(std::string_view piece)>& said = nullptr);

}  // namespace ombre::studio

// The command line: commands, and what happens when one of them fails.
#pragma once

namespace ombre::cli {

// Exit codes.
inline constexpr int done = 0;
inline constexpr int wrong_input = 1;  // the design or the arguments
inline constexpr int failed = 2;       // a file or the machine
inline constexpr int check_failed = 3;
inline constexpr int interrupted = 130;

// Runs a whole command and returns its exit code. Throws nothing.
int run(int argc, const char* const* argv);

}  // namespace ombre::cli

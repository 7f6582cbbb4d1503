// The exit codes of the program.
#pragma once

namespace ombre::jobs {

inline constexpr int done = 0;
inline constexpr int wrong_input = 1;  // the design or the arguments are wrong
inline constexpr int failed = 2;       // a file or the machine failed
inline constexpr int check_failed = 3;
inline constexpr int interrupted = 130;

}  // namespace ombre::jobs

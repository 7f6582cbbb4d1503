// Assertions about internal errors. No design, argument or file may trigger one; wrong input is reported as a
// Diagnostic.
#pragma once

#include <cstdio>
#include <cstdlib>

#define ASSERT(condition)                                                                  \
  do {                                                                                     \
    if (!(condition)) {                                                                    \
      std::fprintf(stderr, "%s:%d: internal error: " #condition "\n", __FILE__, __LINE__); \
      std::abort();                                                                        \
    }                                                                                      \
  } while (false)

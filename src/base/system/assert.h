// Checks on ourselves. No design, argument or file can trip one; if it can, it is a Diagnostic.
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

// Limits beyond which a script is stopped.
#pragma once

#include <cstdint>

namespace ombre::lang {

struct Limits {
  uint64_t elements =
      10'000'000;  // passes of one loop; elements of one list, counted through its nesting; of all lists
  uint64_t text_bytes = 100'000'000;  // of all strings together
  uint64_t instances = 6'000'000;     // nodes made: several for each of a million parts
  uint64_t calls = 3'000'000;         // of modules and children(), which double where modules call themselves twice
  uint64_t steps = 500'000'000;       // expressions and statements evaluated, list elements touched
  uint64_t closures = 1'000'000;      // scopes that function literals keep alive
  int depth = 5000;                   // expressions evaluated inside each other; calls and statements count as two
  int list_depth = 200;               // lists inside lists
  int include_depth = 32;             // files that include or use each other
  int files = 1000;                   // files read by include and use
};

}  // namespace ombre::lang

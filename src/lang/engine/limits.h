// Limits that stop a script.
#pragma once

#include <cstdint>

namespace ombre::lang {

struct Limits {
  uint64_t elements =
      10'000'000;  // passes of one loop; elements of one list, nested ones included; elements of all lists
  uint64_t text_bytes = 100'000'000;  // total size of all strings
  uint64_t instances = 6'000'000;     // number of nodes that are made: several for each of a million parts
  uint64_t calls = 3'000'000;         // calls of modules and children()
  uint64_t steps = 500'000'000;   // expressions and statements that are evaluated, and list elements that are accessed
  uint64_t closures = 1'000'000;  // scopes that function literals keep alive
  int depth = 5000;               // nested expressions; calls and statements count as two
  int list_depth = 200;           // nested lists
  int include_depth = 32;         // nested include and use
  int files = 1000;               // files read by include and use
};

}  // namespace ombre::lang

// Warnings that state how often something was found in a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"

namespace ombre::formats {

class CountedWarnings {
 public:
  static constexpr size_t most_kinds = 20;  // further kinds are counted together

  // Adds a warning: `one` is the whole sentence if it occurs once, `many` what follows the number otherwise, such as "a
  // face of two corners is a line" and "faces of two corners are lines". Warnings with equal `many` are counted
  // together.
  void add(const std::string& one, const std::string& many, uint64_t times = 1);

  // Reports one warning of each kind, in the order in which they were first added. `file` begins each message.
  void report(const std::string& file, Diagnostics& diagnostics) const;

 private:
  struct Entry {
    std::string one, many;
    uint64_t count = 0;
  };
  std::vector<Entry> entries_;
  uint64_t others_ = 0;
};

}  // namespace ombre::formats

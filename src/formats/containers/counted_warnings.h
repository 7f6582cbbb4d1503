// Warnings that say how often something was found in a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"

namespace ombre::formats {

class CountedWarnings {
 public:
  static constexpr size_t most_kinds = 20;  // what comes after these is counted together

  // What is said if it is found once, a whole sentence, and what follows the number if it is found more often: "a face
  // of two corners is a line" and "faces of two corners are lines". Equal `many` count together.
  void add(const std::string& one, const std::string& many, uint64_t times = 1);

  // One warning for each, in the order in which they were first added. `file` is the name that begins each message.
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

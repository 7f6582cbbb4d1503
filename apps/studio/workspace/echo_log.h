// The lines that a script says, within bounds.
#pragma once

#include <string>
#include <vector>

#include "base/text/data.h"

namespace ombre::studio {

// Keeps the first lines, and of long lines the beginning, so that no script fills the memory of server and page.
class EchoLog {
 public:
  static constexpr size_t most_lines = 200, most_line_bytes = 4096, most_bytes = 128 << 10;

  // Returns true if the line, or its beginning, is kept.
  bool add(const std::string& line);
  // Returns the kept lines, and a last one that says how much was left out, if anything was.
  DataList lines() const;
  size_t lines_left_out() const { return lines_left_out_; }

 private:
  std::vector<std::string> kept_;
  size_t bytes_ = 0, lines_left_out_ = 0;
};

// Returns the longest beginning of a text with at most this many bytes that ends with a whole character in UTF-8.
std::string beginning_of(const std::string& text, size_t most_bytes);

}  // namespace ombre::studio

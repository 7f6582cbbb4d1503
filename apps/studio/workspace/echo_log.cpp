#include "studio/workspace/echo_log.h"

namespace ombre::studio {

std::string beginning_of(const std::string& text, size_t most_bytes) {
  if (text.size() <= most_bytes) return text;
  size_t end = most_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end);
}

bool EchoLog::add(const std::string& line) {
  if (kept_.size() >= most_lines || bytes_ >= most_bytes) {
    ++lines_left_out_;
    return false;
  }
  kept_.push_back(beginning_of(line, most_line_bytes));
  bytes_ += kept_.back().size();
  if (kept_.back().size() == line.size()) return true;
  kept_.back() += " ... (" + std::to_string(line.size() - kept_.back().size()) + " more bytes)";
  return true;
}

DataList EchoLog::lines() const {
  DataList list(kept_.begin(), kept_.end());
  if (lines_left_out_ > 0) list.emplace_back("... and " + std::to_string(lines_left_out_) + " more lines");
  return list;
}

}  // namespace ombre::studio

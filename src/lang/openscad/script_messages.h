// Messages of a running script in OpenSCAD's wording, since users and tools read these lines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

#include "base/text/diagnostic.h"

namespace ombre::lang::openscad {

struct Message {
  enum class Kind : uint8_t { echo, warning, deprecated, error, trace, note };
  Kind kind = Kind::echo;
  std::string text;
  std::string file;  // empty if the message has no position
  int line = 0;
  Code code = Code::script;  // code of an error

  bool operator==(const Message&) const = default;
};

// Returns "WARNING: text in file F, line N".
std::string to_line(const Message& message);

// Keeps the messages of one run in order. As in OpenSCAD, a message that equals each of the last five (except echoes)
// is dropped, and so is a repeated one about a deprecated form.
class Messages {
 public:
  // Each message is also passed to `sink`, unless that is empty.
  explicit Messages(std::function<void(const Message&)> sink = {}) : sink_(std::move(sink)) {}

  void add(Message message);
  const std::vector<Message>& list() const { return list_; }
  size_t warning_count() const { return warnings_; }
  size_t error_count() const { return errors_; }
  // Returns all lines with their line endings, the content of `-o file.echo`.
  std::string text() const;

  // Syntax errors of the script, and errors in calls of Ombre's words, in more detail than OpenSCAD reports them.
  Diagnostics details;

 private:
  // Messages that are kept, and their bytes; a script with more is stopped by its limits, or goes on unheard.
  static constexpr size_t most = 1'000'000, most_bytes = size_t{64} << 20;

  std::function<void(const Message&)> sink_;
  std::vector<Message> list_;
  std::array<Message, 5> latest_;
  std::unordered_set<std::string> deprecated_;  // lines that were already reported
  size_t next_ = 0, bytes_ = 0;
  size_t warnings_ = 0, errors_ = 0;
};

}  // namespace ombre::lang::openscad

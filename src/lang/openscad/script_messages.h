// What OpenSCAD says while it runs a script, in its wording: users and their tools read these lines.
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
  std::string file;  // empty: nowhere in particular
  int line = 0;
  Code code = Code::script;  // of an error

  bool operator==(const Message&) const = default;
};

// "WARNING: text in file F, line N".
std::string to_line(const Message& message);

// Keeps the messages of one run in their order. A message that is equal to each of the five before it (echoes aside) is
// left out, as is a repeated one about an old form: OpenSCAD does so.
class Messages {
 public:
  // Each message is also given to `sink` at once, unless it is empty.
  explicit Messages(std::function<void(const Message&)> sink = {}) : sink_(std::move(sink)) {}

  void add(Message message);
  const std::vector<Message>& list() const { return list_; }
  size_t warning_count() const { return warnings_; }
  size_t error_count() const { return errors_; }
  // All lines, each with its end: what `-o file.echo` holds.
  std::string text() const;

  // What is wrong in the text of the script, or in a call of Ombre's words, in more words than OpenSCAD has for it.
  Diagnostics details;

 private:
  static constexpr size_t most = 1'000'000;  // messages kept; a script that says more is stopped by its limits

  std::function<void(const Message&)> sink_;
  std::vector<Message> list_;
  std::array<Message, 5> latest_;
  std::unordered_set<std::string> deprecated_;  // lines that were said
  size_t next_ = 0;
  size_t warnings_ = 0, errors_ = 0;
};

}  // namespace ombre::lang::openscad

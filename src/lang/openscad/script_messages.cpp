#include "lang/openscad/script_messages.h"

#include <algorithm>

namespace ombre::lang::openscad {
namespace {

// They stand in the order of Message::Kind.
constexpr std::array prefixes{"ECHO: ", "WARNING: ", "DEPRECATED: ", "ERROR: ", "TRACE: ", ""};
static_assert(prefixes.size() == static_cast<size_t>(Message::Kind::note) + 1);

}  // namespace

std::string to_line(const Message& message) {
  std::string line = prefixes[static_cast<size_t>(message.kind)] + message.text;
  if (!message.file.empty()) line += " in file " + message.file + ", line " + std::to_string(message.line);
  return line;
}

void Messages::add(Message message) {
  if (message.kind == Message::Kind::deprecated && !deprecated_.insert(to_line(message)).second) return;
  if (message.kind != Message::Kind::echo) {
    if (std::ranges::all_of(latest_, [&](const Message& before) { return before == message; })) return;
    latest_[next_++ % latest_.size()] = message;
  }
  warnings_ += message.kind == Message::Kind::warning ? 1 : 0;
  errors_ += message.kind == Message::Kind::error ? 1 : 0;
  if (sink_) sink_(message);
  if (list_.size() >= most || bytes_ >= most_bytes) return;
  bytes_ += message.text.size();
  list_.push_back(std::move(message));
}

std::string Messages::text() const {
  std::string text;
  for (const Message& message : list_) text += to_line(message) + '\n';
  return text;
}

}  // namespace ombre::lang::openscad

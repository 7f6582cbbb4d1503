// What the user sees: data on stdout, everything for people on stderr, or events for programs.
#include "ombre/console.h"

#include <unistd.h>
#include <cerrno>
#include <system_error>

#include <cstdio>
#include <cstdlib>

#include "base/text/error.h"
#include "base/text/json.h"
#include "ombre/host.h"

namespace ombre::cli {
namespace {

void put(std::FILE* stream, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

// Data that does not arrive is a failure; a remark for people that nobody reads is not.
void put_data(const std::string& text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written)
    throw Error(Code::cannot_write, "cannot write to standard output: " + std::generic_category().message(errno));
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
  return value && *value;
}

std::string labelled(const std::string& severity, const char* colour, bool has_colour) {
  return "ombre: " + (has_colour ? colour + severity + "\033[0m" : severity) + ": ";
}

DataMembers message_members(std::string_view severity, const std::string& message, Code code,
                            const CodeValues& values) {
  DataMembers named;
  for (const auto& [name, value] : values) named.emplace_back(name, value);
  return {{"severity", std::string(severity)},
          {"message", message},
          {"code", std::string(name_of(code))},
          {"values", Data(std::move(named))}};
}

}  // namespace

Console::Console(const Host& host)
    : voice_(host.on_event ? Voice::programs : Voice::people),
      front_end_(host.front_end),
      on_event_(host.on_event),
      on_data_(host.on_data) {}

void Console::print(const std::string& text) const { on_data_ ? on_data_(text) : put_data(text); }

void Console::event(const std::string& event_name, DataMembers members) const {
  if (voice_ != Voice::programs) return;
  members.emplace(members.begin(), "event", event_name);
  on_event_ ? on_event_(members) : put_data(print_json_line(members) + '\n');
}

void Console::say(const Phrase& text) const {
  if (voice_ == Voice::people) put(stderr, text.in({{}, front_end_}) + '\n');
}

void Console::warn(const Phrase& message, Code code) const {
  const std::string text = message.in({{}, front_end_});
  if (voice_ == Voice::programs) return event("message", message_members("warning", text, code, {}));
  if (voice_ == Voice::people) put(stderr, labelled("warning", "\033[1;33m", has_colour()) + text + '\n');
}

void Console::error(Code code, const Phrase& message, const CodeValues& values) const {
  const std::string text = message.in({{}, front_end_});
  if (voice_ == Voice::programs) return event("message", message_members("error", text, code, values));
  put(stderr, labelled("error", "\033[1;31m", has_colour()) + text + '\n');
}

void Console::diagnose(const Diagnostics& diagnostics) const {
  if (voice_ == Voice::people) return put(stderr, to_text(diagnostics, front_end_));
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    if (voice_ == Voice::programs) event("message", members_of(diagnostic));
    if (voice_ == Voice::quiet && diagnostic.severity == Severity::error) put(stderr, to_text(diagnostic, front_end_));
  }
}

DataMembers Console::members_of(const Diagnostic& diagnostic) const {
  DataMembers members =
      message_members(name_of(diagnostic.severity), diagnostic.message, diagnostic.code, diagnostic.values);
  members.emplace_back("hint", hint_of(diagnostic, front_end_));
  if (!diagnostic.where.source) return members;
  const Place place = diagnostic.where.source->place(diagnostic.where.begin);
  members.emplace_back("file", diagnostic.where.source->name());
  members.emplace_back("line", static_cast<double>(place.line));
  members.emplace_back("column", static_cast<double>(place.column));
  return members;
}

bool Console::is_terminal() const { return ::isatty(STDERR_FILENO) != 0; }

bool Console::has_colour() const { return is_terminal() && !is_set("NO_COLOR"); }

}  // namespace ombre::cli

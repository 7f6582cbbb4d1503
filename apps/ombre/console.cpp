// What the user sees: data on stdout, everything for people on stderr, or events for programs.
#include "ombre/console.h"

#include <unistd.h>
#include <cerrno>
#include <system_error>

#include <cstdio>
#include <cstdlib>

#include "base/error.h"
#include "base/json.h"
#include "ombre/command_line.h"

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
  if (!written) throw Error("cannot write to standard output: " + std::generic_category().message(errno));
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
  return value && *value;
}

}  // namespace

Console::Console(const Host& host)
    : voice_(host.on_event ? Voice::programs : Voice::people), on_event_(host.on_event), on_data_(host.on_data) {}

void Console::print(const std::string& text) const { on_data_ ? on_data_(text) : put_data(text); }

void Console::event(const std::string& event_name, DataMembers members) const {
  if (voice_ != Voice::programs) return;
  members.emplace(members.begin(), "event", event_name);
  on_event_ ? on_event_(members) : put_data(print_json_line(members) + '\n');
}

void Console::say(const std::string& text) const {
  if (voice_ == Voice::people) put(stderr, text + '\n');
}

void Console::report(const char* severity, const char* colour, const std::string& message) const {
  if (voice_ == Voice::programs) return event("message", {{"severity", severity}, {"message", message}});
  const std::string label = has_colour() ? std::string(colour) + severity + "\033[0m" : severity;
  put(stderr, "ombre: " + label + ": " + message + '\n');
}

void Console::warn(const std::string& message) const {
  if (voice_ != Voice::quiet) report("warning", "\033[1;33m", message);
}

void Console::error(const std::string& message) const { report("error", "\033[1;31m", message); }

void Console::diagnose(const Diagnostics& diagnostics) const {
  if (voice_ == Voice::people) return put(stderr, to_text(diagnostics));
  for (const Diagnostic& diagnostic : diagnostics.list()) {
    if (voice_ == Voice::quiet) {
      if (diagnostic.severity == Severity::error) put(stderr, to_text(diagnostic));
      continue;
    }
    DataMembers members{{"severity", std::string(name_of(diagnostic.severity))},
                        {"message", diagnostic.message},
                        {"hint", diagnostic.hint}};
    if (diagnostic.where.source) {
      const Place place = diagnostic.where.source->place(diagnostic.where.begin);
      members.emplace_back("file", diagnostic.where.source->name());
      members.emplace_back("line", static_cast<double>(place.line));
      members.emplace_back("column", static_cast<double>(place.column));
    }
    event("message", std::move(members));
  }
}

bool Console::is_terminal() const { return ::isatty(STDERR_FILENO) != 0; }

bool Console::has_colour() const { return is_terminal() && !is_set("NO_COLOR"); }

}  // namespace ombre::cli

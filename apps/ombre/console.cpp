// Output: data on stdout, messages for people on stderr, or events for programs.
#include "ombre/console.h"

#include <unistd.h>
#include <cerrno>
#include <system_error>

#include <cstdio>

#include "base/system/environment.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "ombre/progress_line.h"

namespace ombre::cli {
namespace {

void put(std::FILE* stream, const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

// Writes data to stdout, and throws Error if that fails. Failures of remarks for people are ignored.
void put_data(const std::string& text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written)
    throw Error(Code::cannot_write, "cannot write to standard output: " + std::generic_category().message(errno));
}

bool is_set(const char* variable) { return !environment(variable).empty(); }

std::string labelled(const std::string& severity, const char* colour, bool has_colour) {
  return "ombre: " + (has_colour ? colour + severity + "\033[0m" : severity) + ": ";
}

class Silence final : public jobs::ShownProgress {
 public:
  void update(const HowFar&) override {}
  void finish() override {}
};

}  // namespace

Console::Console(const Host& host)
    : voice_(host.on_event ? Voice::programs : Voice::people),
      front_end_(host.front_end),
      data_(
          host.front_end,
          host.on_event ? host.on_event : [](const DataMembers& event) { put_data(print_json_line(event) + '\n'); },
          host.on_data ? host.on_data : put_data) {}

void Console::event(const std::string& name, DataMembers members) const {
  if (wants_data()) data_.event(name, std::move(members));
}

void Console::say(const Phrase& text) const {
  if (voice_ == Voice::people) put(stderr, text.in({{}, front_end_}) + '\n');
}

void Console::warn(const Phrase& message, Code code) const {
  if (wants_data()) return data_.warn(message, code);
  if (voice_ == Voice::people)
    put(stderr, labelled("warning", "\033[1;33m", has_colour()) + message.in({{}, front_end_}) + '\n');
}

void Console::error(Code code, const Phrase& message, const CodeValues& values) const {
  if (wants_data()) return data_.error(code, message, values);
  put(stderr, labelled("error", "\033[1;31m", has_colour()) + message.in({{}, front_end_}) + '\n');
}

void Console::diagnose(const Diagnostics& diagnostics) const {
  if (wants_data()) return data_.diagnose(diagnostics);
  if (voice_ == Voice::people) return put(stderr, to_text(diagnostics, front_end_));
  for (const Diagnostic& diagnostic : diagnostics.list())
    if (diagnostic.severity == Severity::error) put(stderr, to_text(diagnostic, front_end_));
}

std::unique_ptr<jobs::ShownProgress> Console::progress(jobs::Counted counted) const {
  if (wants_data()) return data_.progress(counted);
  if (voice_ == Voice::quiet) return std::make_unique<Silence>();
  return std::make_unique<ProgressLine>(is_terminal(), counted);
}

bool Console::is_terminal() const { return ::isatty(STDERR_FILENO) != 0; }

bool Console::has_colour() const { return is_terminal() && !is_set("NO_COLOR"); }

}  // namespace ombre::cli

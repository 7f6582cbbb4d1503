#include "lang/openscad/script_diagnostics.h"

#include <algorithm>

namespace ombre::lang::openscad {
namespace {

// Returns the line of a message about the script itself, or the call for other messages.
SourceRange place_of(const Message& message, const SourcePtr& script, const SourceRange& call) {
  if (message.line < 1 || message.file.empty()) return call;
  const std::string& name = script->name();
  if (message.file != name && !name.ends_with('/' + message.file)) return call;
  const std::string_view text = script->text();
  size_t begin = 0;
  for (int line = 1; line < message.line && begin < text.size(); ++line)
    begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  const size_t end = std::min(text.find('\n', begin), text.size());
  return {script, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
}

}  // namespace

void add_diagnostics(const Messages& messages, const SourcePtr& script, const SourceRange& otherwise,
                     Diagnostics& diagnostics) {
  using Kind = Message::Kind;
  diagnostics.add_all(messages.details);
  for (const Message& message : messages.list()) {
    const SourceRange where = place_of(message, script, otherwise);
    // The text of a message about another file names the line.
    const std::string text = where == otherwise && !message.file.empty() ? to_line(message) : message.text;
    if (message.kind == Kind::error && !messages.details.has_errors())
      diagnostics.error(message.code, where, text);
    else if (message.kind == Kind::warning || message.kind == Kind::deprecated)
      diagnostics.warning(where, text);
    else if (message.kind == Kind::echo)
      diagnostics.note(where, to_line(message));
  }
}

}  // namespace ombre::lang::openscad

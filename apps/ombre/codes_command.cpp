// ombre codes: the codes that messages have for programs.
#include <algorithm>
#include <memory>

#include "base/text/code.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"

namespace ombre::cli {
namespace {

void list_codes(const Session& session) {
  size_t width = 0;
  for (const CodeInfo& info : codes()) width = std::max(width, info.name.size());
  for (const CodeInfo& info : codes()) {
    std::string name(info.name);
    const std::string sentence(info.sentence);
    if (session.console.voice() == Voice::programs)
      session.console.event("code", {{"name", name}, {"help", sentence}, {"values", std::string(info.values)}});
    else
      session.console.print(name.append(width + 2 - name.size(), ' ').append(sentence).append("\n"));
  }
}

// The reference: a table with a row for each code.
std::string reference() {
  std::string text =
      "# Codes of messages\n\nMade by `ombre codes --markdown`. A message has a code, which stays the same where its "
      "words change, and values, which\nsay what it is about. `--json` prints both in the events `message`; in Python "
      "they are `error.code` and `error.values`, and\nmembers of each of `error.diagnostics`. What a message says to "
      "write instead (`hint`) is spelled in the language of the\ndesign. A value may be missing where it says "
      "nothing.\n\n| code | means | values |\n| --- | --- | --- |\n";
  for (const CodeInfo& info : codes())
    text += "| `" + std::string(info.name) + "` | " + std::string(info.sentence) + " | " + std::string(info.values) +
            " |\n";
  return text;
}

}  // namespace

Command add_codes(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("codes", "List the codes that messages have for programs");
  auto markdown = std::make_shared<bool>(false);
  app->add_flag("--markdown", *markdown, "Print the whole reference");
  add_output_options(*app, output);
  app->footer("Example:\n  ombre codes\n");
  return {app, [markdown](Session& session) {
            if (*markdown)
              session.console.print(reference());
            else
              list_codes(session);
            return done;
          }};
}

}  // namespace ombre::cli

// `ombre codes` lists the codes that messages have for programs.
#include <algorithm>
#include <memory>

#include "base/text/code.h"
#include "base/text/markdown.h"
#include "jobs/common/job_kind.h"
#include "jobs/reference/list_or_page.h"

namespace ombre::jobs {
namespace {

void list_codes(const Session& session) {
  size_t width = 0;
  for (const CodeInfo& info : codes()) width = std::max(width, info.name.size());
  for (const CodeInfo& info : codes()) {
    std::string name(info.name);
    const std::string sentence(info.sentence);
    if (session.events.wants_data())
      session.events.event("code", {{"name", name}, {"help", sentence}, {"values", std::string(info.values)}});
    else
      session.events.print(name.append(width + 2 - name.size(), ' ').append(sentence).append("\n"));
  }
}

// Returns the reference: a table with a row for each code.
std::string codes_reference() {
  std::string text =
      "# Codes of messages\n\nMade by `ombre codes --markdown`. A message has a code, which stays the same where its "
      "words change, and values, which\nsay what it is about. `--json` prints both in the events `message`; in Python "
      "they are `error.code` and `error.values`, and\nmembers of each of `error.diagnostics`. What a message says to "
      "write instead (`hint`) is spelled in the language of the\ndesign. A value may be missing where it says "
      "nothing.\n\n| code | means | values |\n| --- | --- | --- |\n";
  for (const CodeInfo& info : codes())
    text += table_row({"`" + std::string(info.name) + "`", std::string(info.sentence), std::string(info.values)});
  return text;
}

}  // namespace

JobKind codes_kind() {
  return job_kind<ListChoices>("codes", "List the codes that messages have for programs", "Example:\n  ombre codes\n",
                               list_or_print<list_codes, codes_reference>);
}

}  // namespace ombre::jobs

// `ombre commands` lists the commands with their options.
#include <memory>

#include "base/text/markdown.h"
#include "base/text/text.h"
#include "jobs/all_jobs.h"
#include "ombre/commands.h"
#include "options/members.h"

namespace ombre::cli {
namespace {

std::string table_of(const jobs::JobKind& kind) {
  std::string text = "\n## " + kind.name + "\n\n" + kind.help + ".\n\n| option | takes | |\n| --- | --- | --- |\n";
  for (const options::Option& option : kind.options()) {
    const std::string takes = option.choices.empty() ? option.placeholder : join(option.choices, ", ");
    text += table_row(
        {"`" + option.names + "`",
         (takes.empty() ? "" : "`" + takes + "`") + (option.takes == options::Takes::several ? ", several times" : ""),
         option.help + (option.is_required ? "; required" : "")});
  }
  return text;
}

std::string reference() {
  std::string text =
      "# Commands\n\nMade by `ombre commands --markdown`; `ombre COMMAND --help` shows one. In Python, options are "
      "keyword "
      "arguments with `_` in\nplace of `-`: `layer_height=0.1`. Each command has `--quiet` and `--json` besides. "
      "Lengths "
      "are mm, angles degrees.\n";
  for (const jobs::JobKind& kind : jobs::all_jobs()) text += table_of(kind);
  return text;
}

void list_commands(const CommandSession& session) {
  size_t width = 0;
  for (const jobs::JobKind& kind : jobs::all_jobs()) width = std::max(width, kind.name.size());
  for (const jobs::JobKind& kind : jobs::all_jobs()) {
    std::string name = kind.name;
    if (session.console.wants_data())
      session.console.event("command",
                            {{"name", name}, {"help", kind.help}, {"options", options::describe(kind.options())}});
    else
      session.console.print(name.append(width + 2 - name.size(), ' ') + kind.help + '\n');
  }
}

}  // namespace

Command add_commands(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("commands", "List the commands that do jobs, with their options");
  auto markdown = std::make_shared<bool>(false);
  app->add_flag("--markdown", *markdown, "Print the whole reference");
  add_output_options(*app, output);
  app->footer("Example:\n  ombre commands --json\n");
  return {app, [markdown](CommandSession& session) {
            if (*markdown)
              session.console.print(reference());
            else
              list_commands(session);
            return jobs::done;
          }};
}

}  // namespace ombre::cli

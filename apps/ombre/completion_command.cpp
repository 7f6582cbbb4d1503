// `ombre completion` prints scripts for shells that complete commands, options and their values.
#include <memory>

#include "base/text/text.h"
#include "ombre/checks.h"
#include "ombre/commands.h"
#include "ombre/completion.h"

namespace ombre::cli {

Command add_completion(CLI::App& program) {
  CLI::App* app = program.add_subcommand("completion", "Print a script that completes what is typed in a shell");
  auto shell = std::make_shared<std::string>();
  app->add_option("shell", *shell, "The shell: " + join(completion_shells(), ", "))
      ->required()
      ->check(one_of(completion_shells()))
      ->type_name("SHELL");
  app->footer(
      "Examples:\n  source <(ombre completion bash)    in ~/.bashrc\n"
      "  source <(ombre completion zsh)     in ~/.zshrc, after compinit\n"
      "  ombre completion fish | source     in ~/.config/fish/config.fish\n");
  return {app, [shell](CommandSession& session) {
            session.console.print(completion_script(*shell));
            return jobs::done;
          }};
}

}  // namespace ombre::cli

// What to say when the arguments do not fit.
#include "ombre/suggest.h"

#include <algorithm>
#include <vector>

#include "base/text.h"

namespace ombre::cli {
namespace {

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

const CLI::App& chosen_command(const CLI::App& program) {
  const auto chosen = program.get_subcommands();
  return chosen.empty() ? program : *chosen.front();
}

}  // namespace

std::string unknown_command(const CLI::App& program, const std::string& argument) {
  const std::vector<std::string> names = command_names(program);
  if (argument.starts_with('-') || std::find(names.begin(), names.end(), argument) != names.end()) return "";
  std::string text = "there is no command \"" + argument + '"';
  if (argument.ends_with(".vcad")) return text + "; did you mean \"ombre slice " + argument + "\"?";
  if (const std::string hint = did_you_mean(argument, names); !hint.empty()) return text + "; " + hint;
  return text + "; there are " + join(names, ", ");
}

std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = chosen_command(program);
  const std::string help = "; see ombre " + (&command == &program ? "" : command.get_name() + ' ') + "--help";
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return std::string(error.what()) + help;

  // CLI11 lists what was left over, of the program and of the command.
  const std::vector<std::string> left_over = program.remaining(true);
  if (left_over.empty()) return std::string(error.what()) + help;
  const auto first_option =
      std::find_if(left_over.begin(), left_over.end(), [](const std::string& s) { return s.starts_with('-'); });
  if (first_option == left_over.end()) return "one argument too many: \"" + left_over.front() + '"' + help;
  const std::string option = first_option->substr(0, first_option->find('='));
  const std::string hint = did_you_mean(option, option_names(command));
  return "there is no option " + option + (hint.empty() ? help : "; " + hint);
}

}  // namespace ombre::cli

// Explains arguments that do not fit.
#include "ombre/suggest.h"

#include <algorithm>
#include <vector>

#include "base/text/text.h"

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

// Returns an option with its value as in a help: "--zoom X", "FOLDER".
std::string with_value(const CLI::App& command, const std::string& name) {
  const CLI::Option* option = command.get_option_no_throw(name);
  if (!option) return name;
  // The values that the option accepts follow the colon (checks.h).
  const std::string type = option->get_type_name();
  const size_t accepted =
      std::min(type.find(":{"), type.find(" to ") == std::string::npos ? type.npos : type.find(':'));
  const std::string value = type.substr(0, accepted);
  return name.starts_with('-') ? name + ' ' + value : value;
}

const CLI::App& chosen_command(const CLI::App& program) {
  const auto chosen = program.get_subcommands();
  return chosen.empty() ? program : *chosen.front();
}

// Rewrites texts such as "--zoom: 1 required X:0.01 to 1000 missing" so that people see what to write.
std::string in_other_words(const CLI::App& command, const CLI::ParseError& error) {
  const std::string text = error.what();
  const auto before = [&](const char* words) { return text.substr(0, text.find(words)); };
  const auto after = [&](const char* words) { return text.substr(text.find(words) + std::string_view(words).size()); };
  if (dynamic_cast<const CLI::ExcludesError*>(&error))
    return before(" excludes ") + " and " + after(" excludes ") + " do not go together";
  if (dynamic_cast<const CLI::RequiredError*>(&error)) {
    const std::string name = before(" is required");
    const std::string call = "ombre " + command.get_name() + ' ';
    if (name == "design") return "the design is missing; write for example " + call + "part.vcad";
    return name + " is missing; write " + call + "... " + with_value(command, name);
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    const std::string name = before(":");
    if (text.ends_with(" missing")) return name + " needs a value: " + with_value(command, name);
    if (text.find("At Most") != std::string::npos) return name + " is given more than once";
  }
  return text;
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
  // CLI11 lists the arguments that were left over, of the program and of the command.
  const std::vector<std::string> left_over = program.remaining(true);
  const auto first_option =
      std::find_if(left_over.begin(), left_over.end(), [](const std::string& s) { return s.starts_with('-'); });
  // A missing required option may have been given with a slip in its name.
  const bool is_slip = dynamic_cast<const CLI::RequiredError*>(&error) && first_option != left_over.end();
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) && !left_over.empty();
  if (!is_slip && !is_extra) {
    const std::string text = in_other_words(command, error);
    return text.ends_with('?') ? text : text + help;
  }
  if (first_option == left_over.end()) return "one argument too many: \"" + left_over.front() + '"' + help;
  const std::string option = first_option->substr(0, first_option->find('='));
  const std::string hint = did_you_mean(option, option_names(command));
  return "there is no option " + option + (hint.empty() ? help : "; " + hint);
}

}  // namespace ombre::cli

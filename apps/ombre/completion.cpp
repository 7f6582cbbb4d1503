#include "ombre/completion.h"

#include "base/text/error.h"
#include "base/text/text.h"
#include "load/find_calibration.h"
#include "load/find_printer.h"
#include "load/library_folders.h"
#include "load/library_operators.h"
#include "load/node_registry.h"

namespace ombre::cli {
namespace {

// Returns the names of files that come with Ombre; nothing if its data are not found.
std::vector<Completion> shipped(std::vector<std::string> (&names)()) {
  std::vector<Completion> found;
  try {
    for (const std::string& name : names()) found.push_back({name, ""});
  } catch (const Error&) {
    return {};
  }
  return found;
}

std::vector<Completion> nodes() {
  std::vector<Completion> found;
  for (const auto& type : compile::node_registry().types()) found.push_back({type->name, type->sentence});
  try {
    for (const compile::Operator& op : compile::operators_in(compile::library_folders()))
      found.push_back({op.declaration.name, op.declaration.sentence});
  } catch (const Error&) {
    return found;
  }
  return found;
}

// Returns the values that an option accepts, from its type, such as "MODE:{blue,white}" (checks.h).
std::vector<Completion> choices(const CLI::Option& option) {
  const std::string name = option.get_name(), type = option.get_type_name();
  if (name == "printer" || name == "--printer") return shipped(compile::printer_names);
  if (name == "calibration" || name == "--calibration") return shipped(compile::calibration_names);
  if (name == "node" || name == "operator") return nodes();
  const size_t begin = type.find(":{"), end = type.rfind('}');
  std::vector<Completion> found;
  if (begin == std::string::npos || end == std::string::npos) return found;
  for (const std::string& word : split(type.substr(begin + 2, end - begin - 2), ',')) found.push_back({word, ""});
  return found;
}

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

std::vector<Completion> commands(const CLI::App& program) {
  std::vector<Completion> found;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    found.push_back({command->get_name(), command->get_description()});
  return found;
}

std::vector<Completion> options(const CLI::App& command) {
  std::vector<Completion> found;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) found.push_back({"--" + name, option->get_description()});
    for (const std::string& name : option->get_snames()) found.push_back({"-" + name, option->get_description()});
  }
  return found;
}

// Returns the positional argument that comes after `count` others; a list takes all further ones.
const CLI::Option* argument(const CLI::App& command, size_t count) {
  const CLI::Option* last = nullptr;
  for (const CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->get_positional(); })) {
    if (count == 0) return option;
    --count;
    last = option;
  }
  return last && last->get_items_expected_max() > 1 ? last : nullptr;
}

std::vector<Completion> within_command(const CLI::App& command, const std::vector<std::string>& words) {
  size_t arguments = 0;
  const CLI::Option* open = nullptr;  // the option that waits for its value
  for (size_t n = 1; n + 1 < words.size(); ++n) {
    const CLI::Option* option = words[n].starts_with('-') ? command.get_option_no_throw(words[n]) : nullptr;
    if (!open && !words[n].starts_with('-')) ++arguments;
    open = !open && option && !is_flag(*option) ? option : nullptr;
  }
  if (open) return choices(*open);
  if (words.back().starts_with('-')) return options(command);
  const CLI::Option* next = argument(command, arguments);
  return next ? choices(*next) : std::vector<Completion>();
}

}  // namespace

std::vector<Completion> completions(const CLI::App& program, const std::vector<std::string>& words) {
  if (words.empty()) return {};
  std::vector<Completion> found;
  if (words.size() == 1)
    found = words.back().starts_with('-') ? options(program) : commands(program);
  else
    for (const CLI::App* command :
         program.get_subcommands([&](const CLI::App* app) { return app->get_name() == words.front(); }))
      found = within_command(*command, words);
  std::erase_if(found, [&](const Completion& c) { return !c.word.starts_with(words.back()); });
  return found;
}

}  // namespace ombre::cli

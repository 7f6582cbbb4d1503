// The command line: commands, and what happens when one of them fails.
#include "ombre/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <new>
#include <string_view>
#include <vector>

#include "base/text/error.h"
#include "ombre/commands.h"
#include "ombre/completion.h"
#include "ombre/interrupt.h"
#include "ombre/suggest.h"

namespace ombre::cli {
namespace {

constexpr const char* description = "Ombre compiles solids whose material varies through their volume.";
constexpr const char* program_footer =
    "A design is a script (.vcad, or .scad of OpenSCAD), a design file (.json), a bundle (.ombre) or a Python script\n"
    "(.py, whose root it is; see: ombre run -h).\n"
    "ombre COMMAND --help tells more. Lengths are millimetres, angles degrees; z is up, layer 0 the lowest.\n"
    "Exit codes: 0 done, 1 the design or the arguments are wrong, 2 a file or the machine failed,\n"
    "3 a check failed, 130 interrupted.\n";

// Adds what only the options of jobs say of their values.
void add_kind(const Command& command, DataMembers& described) {
  for (const options::Option& option : command.options) {
    if (option.name() != *described.front().second.string()) continue;
    DataList choices(option.choices.begin(), option.choices.end());
    described.emplace_back("kind", option.kind);
    described.emplace_back("choices", std::move(choices));
  }
}

DataList described_options(const Command& command) {
  DataList list;
  for (const CLI::Option* option : command.app->get_options()) {
    DataMembers described{{"name", option->get_name()},
                          {"help", option->get_description()},
                          {"type", option->get_type_name()},
                          {"is_flag", option->get_items_expected_max() == 0},
                          {"is_list", option->get_items_expected_max() > 1}};
    add_kind(command, described);
    list.emplace_back(std::move(described));
  }
  return list;
}

class CommandLine {
 public:
  explicit CommandLine(const Host& host) : program_(description, "ombre"), host_(host), console_(host) {
    program_.footer(program_footer);
    program_.set_version_flag("--version", "ombre " OMBRE_VERSION);
    program_.require_subcommand(0, 1);
    commands_ = {add_slice(program_, output_),    add_layer(program_, output_),      add_render(program_, output_),
                 add_voxels(program_, output_),   add_mesh(program_, output_),       add_contours(program_, output_),
                 add_fea(program_, output_),      add_homogenise(program_, output_), add_sheet(program_, output_),
                 add_probe(program_, output_),    add_info(program_, output_),       add_nodes(program_, output_),
                 add_printers(program_, output_), add_materials(program_, output_),  add_scad(program_, output_),
                 add_studio(program_, output_),   add_bundle(program_, output_),     add_optimise(program_, output_),
                 add_codes(program_, output_),    add_completion(program_)};
    // Only for those who ask what there is: Python runs it before it comes here (python_designs.h).
    program_.add_subcommand("run",
                            "Run a Python script; with --, its root is the design of a command (see: ombre run -h)");
  }

  Data describe() const {
    DataList list;
    for (const Command& command : commands_)
      list.emplace_back(DataMembers{{"name", command.app->get_name()},
                                    {"help", command.app->get_description()},
                                    {"options", described_options(command)}});
    return list;
  }

  int run(int argc, const char* const* argv) {
    if (argc > 2 && std::string_view(argv[1]) == "completion" && std::string_view(argv[2]) == "words")
      return complete({argv + 3, argv + argc});
    // Before the options are known, as wrong ones are reported in the same way.
    if (!host_.on_event && std::find(argv, argv + argc, std::string_view("--json")) != argv + argc)
      console_.set_voice(Voice::programs);
    if (argc > 1)
      if (const std::string problem = unknown_command(program_, argv[1]); !problem.empty()) return wrong(problem);
    try {
      program_.parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help, --version
      return program_.exit(success);
    } catch (const CLI::ParseError& error) {
      return wrong(explain(program_, error));
    } catch (const WrongArgument& error) {
      return wrong(error.message(), error.code());
    }
    if (!host_.on_event)
      console_.set_voice(output_.json ? Voice::programs : output_.quiet ? Voice::quiet : Voice::people);
    for (const Command& command : commands_)
      if (program_.got_subcommand(command.app)) return run(command);
    console_.print(program_.help());
    return wrong_input;
  }

 private:
  int run(const Command& command) {
    if (host_.stop) return run(command, *host_.stop);
    const InterruptGuard interrupt;
    return run(command, interrupt.flag());
  }

  int run(const Command& command, const StopFlag& stop) {
    sources::SourceCache own;
    Session session{console_, stop, host_.load ? host_.load : compile::load_design, host_.cache ? *host_.cache : own};
    try {
      return command.run(session);
    } catch (const WrongArgument& error) {
      return wrong(error.message(), error.code());
    } catch (const Cancelled&) {
      console_.say("interrupted");
      return interrupted;
    } catch (const Error& error) {
      console_.error(error.code(), error.message(), error.values());
      return failed;
    } catch (const std::bad_alloc&) {
      console_.error(Code::memory, "not enough memory; try fewer " + spelled::option("--threads") + ", or a smaller " +
                                       spelled::option("--memory"));
      return failed;
    }
  }

  // Prints a word and what it is on each line, which the scripts of `ombre completion` read.
  int complete(const std::vector<std::string>& words) const {
    std::string text;
    for (const Completion& c : completions(program_, words))
      text += c.word + (c.description.empty() ? "" : '\t' + c.description) + '\n';
    console_.print(text);
    return done;
  }

  int wrong(const Phrase& problem, Code code = Code::option) {
    console_.error(code, problem);
    return wrong_input;
  }

  CLI::App program_;
  const Host& host_;
  Console console_;
  OutputOptions output_;
  std::vector<Command> commands_;
};

}  // namespace

void add_output_options(CLI::App& app, OutputOptions& options) {
  CLI::Option* quiet = app.add_flag("-q,--quiet", options.quiet, "Say nothing but errors");
  app.add_flag("--json", options.json, "For programs: one JSON event a line on stdout")->excludes(quiet);
}

Data describe_commands() {
  const Host none;
  return CommandLine(none).describe();
}

int run(int argc, const char* const* argv, const Host& host) {
  try {
    return CommandLine(host).run(argc, argv);
  } catch (const std::exception& error) {
    Console(host).error(Code::machine, error.what());
    return failed;
  }
}

}  // namespace ombre::cli

// ombre scad: an OpenSCAD script, with the options that OpenSCAD's users type.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>

#include "base/system/temporary_folder.h"
#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "lang/openscad/csg_text.h"
#include "lang/openscad/customizer.h"
#include "lang/openscad/run_script.h"
#include "load/scad_words_design.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/scad_files.h"

namespace ombre::cli {
namespace {

namespace fs = std::filesystem;
namespace openscad = lang::openscad;

struct ScadArguments {
  std::string file;
  std::vector<std::string> outputs, definitions, libraries;
  std::string parameter_file, parameter_set, dependencies, format, materials;
  bool is_quiet = false, stops_at_warnings = false, no_overlap = false;
};

// OpenSCAD's word for binary STL files is binstl.
std::string format_of(const std::string& output, const ScadArguments& arguments) {
  if (!arguments.format.empty()) return arguments.format == "binstl" ? "stl" : arguments.format;
  const std::string ending = fs::path(output).extension().string();
  return ending.empty() ? "" : to_lower(ending.substr(1));
}

bool has_ending(const std::string& path, const std::string& format) { return ending_of(path) == "." + format; }

void write_output(const std::string& path, const std::string& bytes, Session& session) {
  if (path == "-")
    session.console.print(bytes);
  else
    exporting::write_file(path, bytes);
}

// Names that stand in a rule of make: spaces and signs that make reads are escaped.
std::string make_name(const std::string& path) {
  std::string name;
  for (const char c : path) {
    if (c == ' ' || c == '#' || c == '\\') name += '\\';
    if (c == '$') name += '$';
    name += c;
  }
  return name;
}

std::string make_rule(const std::vector<std::string>& outputs, const std::vector<std::string>& files) {
  std::vector<std::string> targets;
  for (const std::string& output : outputs) targets.push_back(make_name(output));
  std::string text = join(targets, " ") + ":";
  for (const std::string& file : files) text += " \\\n\t" + make_name(file);
  return text + "\n";
}

// One run of the command.
class ScadRun {
 public:
  ScadRun(const ScadArguments& arguments, Session& session)
      : arguments_(arguments),
        session_(session),
        source_(read_script(arguments.file)),
        messages_([this](const openscad::Message& message) { show(message); }) {}

  int run() {
    for (const std::string& output : arguments_.outputs) check(output);
    if (!prepare()) return wrong_input;
    Diagnostics found;
    const openscad::Outcome outcome = run_script(found);
    session_.console.diagnose(messages_.details);
    session_.console.diagnose(found);
    const bool is_good = messages_.error_count() == 0 && !found.has_errors() &&
                         !(arguments_.stops_at_warnings && messages_.warning_count() > 0);
    for (const std::string& output : arguments_.outputs)
      if (is_good || format_of(output, arguments_) == "echo") write(output, outcome);
    if (is_good && !write_geometry(outcome)) return wrong_input;
    if (!arguments_.dependencies.empty() && is_good)
      exporting::write_file(arguments_.dependencies, make_rule(arguments_.outputs, outcome.files));
    return is_good ? done : wrong_input;
  }

 private:
  static SourcePtr read_script(const std::string& path) {
    if (path != "-") return make_source(path, formats::read_file(path));
    std::ostringstream text;
    text << std::cin.rdbuf();
    return make_source("<stdin>", text.str());
  }

  void check(const std::string& output) const {
    const std::string format = format_of(output, arguments_);
    if (format == "echo" || format == "csg" || format == "ast") return;
    if (writes_solids(format) && !has_ending(output, format) && output.find("{part}") != std::string::npos)
      throw WrongArgument("a file for each part is named by its ending; write -o " + output + "." + format);
    if (writes_solids(format)) return;
    throw WrongArgument("ombre scad cannot write \"" + output + "\"; write a file that ends in " +
                        join(scad_formats(), ", ") + ", or name one of them with " +
                        spelled::option("--export-format"));
  }

  bool prepare() {
    options_.definitions = arguments_.definitions;
    options_.libraries = arguments_.libraries;
    for (const std::string& folder : openscad::library_folders()) options_.libraries.push_back(folder);
    options_.stop = &session_.stop;
    options_.is_preview = std::ranges::none_of(
        arguments_.outputs, [&](const std::string& output) { return writes_solids(format_of(output, arguments_)); });
    options_.stops_at_warnings = arguments_.stops_at_warnings;
    if (arguments_.parameter_file.empty()) return true;
    Diagnostics found;
    const SourcePtr file = make_source(arguments_.parameter_file, formats::read_file(arguments_.parameter_file));
    const auto set = openscad::parameter_set(file, arguments_.parameter_set, openscad::parameters_of(source_), found);
    session_.console.diagnose(found);
    if (!set) return false;
    options_.definitions.insert(options_.definitions.begin(), set->begin(), set->end());
    return true;
  }

  // A script that uses Ombre's words is a design: its surfaces are meshed only when a file asks for them.
  openscad::Outcome run_script(Diagnostics& found) {
    if (!openscad::uses_words(source_, options_)) return openscad::run_with_files(source_, options_, messages_);
    compile::LoadOptions load;
    load.materials = arguments_.materials;
    load.stop = &session_.stop;
    load.cache = &session_.cache;
    compile::WordsRun made = compile::run_with_words(source_, options_, load, messages_, found);
    if (made.design && !found.has_errors() && design::check_design(*made.design, found))
      design_ =
          std::make_shared<const compile::Loaded>(compile::Loaded{source_->name(), source_, std::move(*made.design)});
    return std::move(made.outcome);
  }

  void write(const std::string& output, const openscad::Outcome& outcome) {
    const std::string format = format_of(output, arguments_);
    if (format == "echo") return write_output(output, messages_.text(), session_);
    if (format == "ast") {
      openscad::Messages ignored;
      return write_output(output, openscad::syntax_tree(source_, options_, ignored).value_or(""), session_);
    }
    if (!outcome.tree) return;
    if (format == "csg")
      return write_output(
          output, openscad::csg_text(*outcome.tree, fs::path(source_->name()).parent_path().string()) + '\n', session_);
  }

  // All files of solids and areas at once, so that the geometry is made once. Writers know formats by their endings, so
  // what has another name, or goes to stdout, is written beside first.
  bool write_geometry(const openscad::Outcome& outcome) {
    const TemporaryFolder beside;
    std::vector<std::string> paths;
    std::map<std::string, std::string> wanted;  // by the file that is written
    for (const std::string& output : arguments_.outputs) {
      const std::string format = format_of(output, arguments_);
      if (!writes_solids(format)) continue;
      paths.push_back(has_ending(output, format) ? output : beside.file(std::to_string(paths.size()) + '.' + format));
      wanted[paths.back()] = output;
    }
    if (paths.empty() || (!design_ && !outcome.tree)) return true;
    const auto files = design_ ? write_design(design_, paths, arguments_.no_overlap, session_)
                               : write_solids(outcome.tree, paths, arguments_.no_overlap, messages_, session_);
    if (!files) return false;
    for (const std::string& file : *files) {
      const auto known = wanted.find(file);
      const std::string& name = known == wanted.end() ? file : known->second;
      if (name != file) write_output(name, formats::read_file(file), session_);
      if (name != "-") tell_file(name);
    }
    return true;
  }

  void tell_file(const std::string& file) const {
    if (session_.console.voice() == Voice::programs)
      session_.console.event("written", {{"file", file}});
    else
      session_.console.say("written to " + file);
  }

  void show(const openscad::Message& message) const {
    const bool is_wrong =
        message.kind == openscad::Message::Kind::error || message.kind == openscad::Message::Kind::trace;
    if (session_.console.voice() == Voice::programs) {
      session_.console.event("message", {{"text", openscad::to_line(message)}});
      return;
    }
    if (arguments_.is_quiet && !is_wrong) return;
    session_.console.say(openscad::to_line(message));
  }

  const ScadArguments& arguments_;
  Session& session_;
  SourcePtr source_;
  openscad::Messages messages_;
  openscad::Options options_;
  compile::LoadedPtr design_;  // of a script with Ombre's words
};

}  // namespace

Command add_scad(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("scad", "Run an OpenSCAD script, and write what it says and makes");
  auto arguments = std::make_shared<ScadArguments>();
  app->add_option("file", arguments->file, "An OpenSCAD script; - for stdin")->required()->type_name("FILE");
  app->add_option("-o", arguments->outputs, "A file to write, by its ending; - for stdout, with --export-format")
      ->type_name("FILE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app->add_option("-D", arguments->definitions, "A value for a variable of the script: -D size=10, -D 'name=\"x\"'")
      ->type_name("NAME=EXPRESSION")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  app->add_option("-p", arguments->parameter_file, "A file of parameter sets")->type_name("FILE");
  app->add_option("-P", arguments->parameter_set, "The parameter set to use")->type_name("NAME");
  app->add_option("-d", arguments->dependencies, "Write the files that the script reads, as a rule for make")
      ->type_name("FILE");
  app->add_option("--export-format", arguments->format, "What to write, whatever the ending")->type_name("FORMAT");
  app->add_option("--library", arguments->libraries, "A folder of libraries, before those of OPENSCADPATH")
      ->type_name("FOLDER")
      ->expected(1)
      ->allow_extra_args(false);
  app->add_option("--materials", arguments->materials, "A materials file, for scripts that say use <ombre>")
      ->type_name("FILE");
  app->add_flag("--no-overlap", arguments->no_overlap, "Where solids overlap, the first one keeps the space");
  app->add_flag("--hardwarnings", arguments->stops_at_warnings, "Stop at the first warning");
  add_output_options(*app, output);
  app->footer("Example:\n  ombre scad box.scad -D width=80 -o box.stl\n");
  return {app, [arguments, &output](Session& session) {
            arguments->is_quiet = output.quiet;
            if (arguments->parameter_file.empty() != arguments->parameter_set.empty())
              throw WrongArgument("-p names a file of parameter sets and -P one of its sets; give both");
            return ScadRun(*arguments, session).run();
          }};
}

}  // namespace ombre::cli

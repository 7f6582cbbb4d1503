// `ombre scad` runs an OpenSCAD script, with the options that OpenSCAD's users know.
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
#include "jobs/common/job_kind.h"
#include "jobs/common/session.h"
#include "jobs/mesh/flavour_option.h"
#include "jobs/scad/scad_files.h"
#include "lang/openscad/csg_text.h"
#include "lang/openscad/customizer.h"
#include "lang/openscad/run_script.h"
#include "load/scad_words_design.h"

namespace ombre::jobs {
namespace {

namespace fs = std::filesystem;
namespace openscad = lang::openscad;

struct ScadChoices {
  std::string file;
  std::vector<std::string> outputs, definitions, libraries;
  std::string parameter_file, parameter_set, dependencies, format, materials;
  bool stops_at_warnings = false, no_overlap = false;
  formats::SlicerFlavour flavour = formats::SlicerFlavour::generic;

  static const options::Spec<ScadChoices>& options() {
    using namespace options;
    static const options::Spec<ScadChoices> spec{
        option("file", &ScadChoices::file, kind::file, "An OpenSCAD script; - for stdin", "FILE").required(),
        options::list("-o,--output", &ScadChoices::outputs, kind::file,
                      "A file to write, by its ending; - for stdout, with --export-format", "FILE"),
        options::list("-D,--define", &ScadChoices::definitions, kind::text,
                      "A value for a variable of the script: -D size=10, -D 'name=\"x\"'", "NAME=EXPRESSION"),
        option("-p,--parameter-file", &ScadChoices::parameter_file, kind::file, "A file of parameter sets", "FILE")
            .needs("--parameter-set"),
        option("-P,--parameter-set", &ScadChoices::parameter_set, kind::text, "The parameter set to use", "NAME")
            .needs("--parameter-file"),
        option("-d,--dependencies", &ScadChoices::dependencies, kind::file,
               "Write the files that the script reads, as a rule for make", "FILE"),
        option("--export-format", &ScadChoices::format, kind::text, "Format to write, whatever the ending", "FORMAT"),
        options::list("--library", &ScadChoices::libraries, kind::file,
                      "A folder of libraries, before those of OPENSCADPATH", "FOLDER"),
        option("--materials", &ScadChoices::materials, kind::file, "A materials file, for scripts that say use <ombre>",
               "FILE"),
        flag("--no-overlap", &ScadChoices::no_overlap, "Where solids overlap, the first one keeps the space"),
        compile::flavour_option(&ScadChoices::flavour),
        flag("--hardwarnings", &ScadChoices::stops_at_warnings, "Stop at the first warning")};
    return spec;
  }
};

// Returns the format; OpenSCAD's word for binary STL files is binstl.
std::string format_of(const std::string& output, const ScadChoices& arguments) {
  if (!arguments.format.empty()) return arguments.format == "binstl" ? "stl" : arguments.format;
  const std::string ending = fs::path(output).extension().string();
  return ending.empty() ? "" : to_lower(ending.substr(1));
}

bool has_ending(const std::string& path, const std::string& format) { return ending_of(path) == "." + format; }

void write_output(const std::string& path, const std::string& bytes, Session& session) {
  if (path == "-")
    session.events.print(bytes);
  else
    exporting::write_file(path, bytes);
}

// Returns a name for a rule of make, with spaces and special characters escaped.
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

// A run of the command.
class ScadRun {
 public:
  ScadRun(const ScadChoices& arguments, Session& session)
      : arguments_(arguments),
        session_(session),
        source_(read_script(arguments.file)),
        messages_([this](const openscad::Message& message) { show(message); }) {}

  int run() {
    for (const std::string& output : arguments_.outputs) check(output);
    if (!prepare()) return wrong_input;
    Diagnostics found;
    const openscad::Outcome outcome = run_script(found);
    session_.events.diagnose(messages_.details);
    session_.events.diagnose(found);
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
    session_.events.diagnose(found);
    if (!set) return false;
    options_.definitions.insert(options_.definitions.begin(), set->begin(), set->end());
    return true;
  }

  // Runs the script. A script that uses Ombre's words is a design, whose surfaces are meshed only when a file asks for
  // them.
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

  // Writes all files of solids and areas at once, so that the geometry is made once. Writers know formats by their
  // endings, so output with another name, or to stdout, is written to a temporary file first.
  bool write_geometry(const openscad::Outcome& outcome) {
    const TemporaryFolder beside;
    SolidsOutput solids{{}, arguments_.no_overlap, arguments_.flavour};
    std::vector<std::string>& paths = solids.paths;
    std::map<std::string, std::string> wanted;  // paths by the file that is written
    for (const std::string& output : arguments_.outputs) {
      const std::string format = format_of(output, arguments_);
      if (!writes_solids(format)) continue;
      paths.push_back(has_ending(output, format) ? output : beside.file(std::to_string(paths.size()) + '.' + format));
      wanted[paths.back()] = output;
    }
    if (paths.empty() || (!design_ && !outcome.tree)) return true;
    const auto files =
        design_ ? write_design(design_, solids, session_) : write_solids(outcome.tree, solids, messages_, session_);
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
    if (session_.events.wants_data())
      session_.events.event("written", {{"file", file}});
    else
      session_.events.say("written to " + file);
  }

  void show(const openscad::Message& message) const {
    if (session_.events.wants_data()) {
      session_.events.event("message", {{"text", openscad::to_line(message)}});
      return;
    }
    session_.events.say(openscad::to_line(message));
  }

  const ScadChoices& arguments_;
  Session& session_;
  SourcePtr source_;
  openscad::Messages messages_;
  openscad::Options options_;
  compile::LoadedPtr design_;  // design of a script with Ombre's words
};

int run_scad(const ScadChoices& a, Session& session) { return ScadRun(a, session).run(); }

}  // namespace

JobKind scad_kind() {
  return job_kind<ScadChoices>("scad", "Run an OpenSCAD script, and write what it says and makes",
                               "Example:\n  ombre scad box.scad -D width=80 -o box.stl\n", run_scad);
}

}  // namespace ombre::jobs

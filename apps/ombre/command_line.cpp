// Runs the command line, and reports why a command fails.
#include "ombre/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include "base/text/error.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "jobs/all_jobs.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/run_reported.h"
#include "jobs/saved_job.h"
#include "load/load.h"
#include "ombre/command_options.h"
#include "ombre/commands.h"
#include "ombre/completion.h"
#include "ombre/interrupt.h"
#include "ombre/suggest.h"
#include "options/members.h"

namespace ombre::cli {
namespace {

constexpr const char* description = "Ombre compiles solids whose material varies through their volume.";
constexpr const char* program_footer =
    "A design is a script (.vcad, or .scad of OpenSCAD), a design file (.json), a bundle (.ombre) or a Python script\n"
    "(.py, whose root it is; see: ombre run -h).\n"
    "ombre COMMAND --help tells more. Lengths are millimetres, angles degrees; z is up, layer 0 the lowest.\n"
    "Exit codes: 0 done, 1 the design or the arguments are wrong, 2 a file or the machine failed,\n"
    "3 a check failed, 130 interrupted.\n";

// A job on the command line, whose options are set while the arguments are read. There are many options, so they are
// added only to the command that is read, described or completed.
struct JobCommand {
  CLI::App* app = nullptr;
  std::function<void()> add_options;
  const jobs::JobKind* kind = nullptr;
  std::shared_ptr<void> job;
  std::shared_ptr<std::string> saved;  // file that the job is saved in; empty: the job is run
};

JobCommand add_job(CLI::App& program, const jobs::JobKind& kind, OutputOptions& output) {
  CLI::App& app = *program.add_subcommand(kind.name, kind.help);
  JobCommand command{&app, {}, &kind, kind.make(), std::make_shared<std::string>()};
  command.add_options = [&app, &kind, &output, job = command.job, saved = command.saved] {
    add_options(app, kind.options(), job.get());
    app.add_option("--save-job", *saved, "Write the job to a file, which ombre job runs, and do nothing")
        ->type_name("FILE");
    add_output_options(app, output);
    if (!kind.footer.empty()) app.footer(kind.footer);
  };
  app.preparse_callback([add = command.add_options](size_t) { add(); });
  return command;
}

// Returns the options that were given, as texts.
DataMembers given_options(const CLI::App& app, const jobs::JobKind& kind) {
  DataMembers given;
  for (const options::Option& option : kind.options()) {
    const CLI::Option* known = app.get_option(option.name());
    if (known->count() == 0) continue;
    const std::vector<std::string> texts = known->results();
    const std::string name = options::member_name(option.name());
    if (option.takes == options::Takes::nothing)
      given.emplace_back(name, true);
    else if (option.takes == options::Takes::several)
      given.emplace_back(name, DataList(texts.begin(), texts.end()));
    else
      given.emplace_back(name, texts.front());
  }
  return given;
}

DataList described_options(const CLI::App& app, const jobs::JobKind* kind) {
  DataList list;
  for (const CLI::Option* option : app.get_options()) {
    DataMembers described{{"name", option->get_name()},
                          {"help", option->get_description()},
                          {"type", option->get_type_name()},
                          {"is_flag", option->get_items_expected_max() == 0},
                          {"is_list", option->get_items_expected_max() > 1}};
    const auto row = kind ? std::ranges::find(kind->options(), option->get_name(), &options::Option::name)
                          : std::vector<options::Option>::const_iterator();
    if (kind && row != kind->options().end()) {  // only options of jobs have a kind of value
      described.emplace_back("kind", row->kind);
      described.emplace_back("choices", DataList(row->choices.begin(), row->choices.end()));
    }
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
    for (const jobs::JobKind& kind : jobs::all_jobs()) jobs_.push_back(add_job(program_, kind, output_));
    commands_ = {add_studio(program_, output_), add_commands(program_, output_), add_completion(program_)};
    job_ = program_.add_subcommand("job", "Run a job that --save-job saved");
    job_->add_option("file", saved_job_, "The saved job")->required()->type_name("FILE");
    add_output_options(*job_, output_);
    job_->footer("Examples:\n  ombre mesh part.vcad --tolerance 0.01 --save-job part.json\n  ombre job part.json\n");
  }

  Data describe() const {
    DataList list;
    const auto add = [&](const CLI::App& app, const jobs::JobKind* kind) {
      list.emplace_back(DataMembers{
          {"name", app.get_name()}, {"help", app.get_description()}, {"options", described_options(app, kind)}});
    };
    for (const JobCommand& job : jobs_) {
      job.add_options();
      add(*job.app, job.kind);
    }
    for (const Command& command : commands_) add(*command.app, nullptr);
    return list;
  }

  int run(int argc, const char* const* argv) {
    if (argc > 2 && std::string_view(argv[1]) == "completion" && std::string_view(argv[2]) == "words")
      return complete({argv + 3, argv + argc});
    // --json is looked for before the options are read, so that wrong options are reported as events, too.
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
    } catch (const options::WrongValue& error) {
      return wrong(error.message(), error.code());
    }
    if (!host_.on_event)
      console_.set_voice(output_.json ? Voice::programs : output_.quiet ? Voice::quiet : Voice::people);
    for (const JobCommand& job : jobs_)
      if (program_.got_subcommand(job.app)) return run([&](const StopFlag& stop) { return run_job(job, stop); });
    if (program_.got_subcommand(job_)) return run([&](const StopFlag& stop) { return run_saved(stop); });
    for (const Command& command : commands_)
      if (program_.got_subcommand(command.app))
        return run([&](const StopFlag& stop) {
          sources::SourceCache own;
          CommandSession session{console_, stop, host_.cache ? *host_.cache : own};
          return command.run(session);
        });
    console_.print(program_.help());
    return jobs::wrong_input;
  }

 private:
  using Work = std::function<int(const StopFlag&)>;

  int run_job(const JobCommand& job, const StopFlag& stop) {
    if (!job.saved->empty()) return save_job(job);
    return in_session(stop, [&](jobs::Session& session) { return job.kind->run(job.job.get(), session); });
  }

  int save_job(const JobCommand& job) const {
    const CLI::Option* force = job.app->get_option_no_throw("--force");
    jobs::refuse_to_overwrite(*job.saved, force && force->count() > 0);
    exporting::write_file(*job.saved,
                          jobs::saved_text({job.kind, given_options(*job.app, *job.kind)}, "ombre " OMBRE_VERSION));
    console_.say("the job is in " + *job.saved + "; ombre job " + *job.saved + " runs it");
    console_.event("saved", {{"file", *job.saved}});
    return jobs::done;
  }

  int run_saved(const StopFlag& stop) {
    Diagnostics diagnostics;
    const auto job = jobs::read_saved_job(make_source(saved_job_, formats::read_file(saved_job_)), diagnostics);
    console_.diagnose(diagnostics);
    if (!job) return jobs::wrong_input;
    return in_session(stop, [&](jobs::Session& session) { return jobs::run_saved_job(*job, session); });
  }

  int in_session(const StopFlag& stop, const std::function<int(jobs::Session&)>& work) {
    sources::SourceCache own;
    jobs::Session session{console_, stop, host_.load ? host_.load : compile::load_design,
                          host_.cache ? *host_.cache : own, "ombre " OMBRE_VERSION};
    if (!host_.stop) session.quit_at_once = [] { return std::make_shared<QuitAtOnce>(); };
    return work(session);
  }

  int run(const Work& work) {
    if (host_.stop) return run(work, *host_.stop);
    const InterruptGuard interrupt;
    return run(work, interrupt.flag());
  }

  int run(const Work& work, const StopFlag& stop) {
    const int code = jobs::run_reported(console_, [&] { return work(stop); });
    if (code == jobs::interrupted) console_.say("interrupted");
    return code;
  }

  // Prints the words that may come next, each with its description, one on a line. The scripts of `ombre completion`
  // read them.
  int complete(const std::vector<std::string>& words) const {
    for (const JobCommand& job : jobs_)
      if (!words.empty() && job.kind->name == words.front()) job.add_options();
    std::string text;
    for (const Completion& c : completions(program_, words))
      text += c.word + (c.description.empty() ? "" : '\t' + c.description) + '\n';
    console_.print(text);
    return jobs::done;
  }

  int wrong(const Phrase& problem, Code code = Code::option) {
    console_.error(code, problem);
    return jobs::wrong_input;
  }

  CLI::App program_;
  const Host& host_;
  Console console_;
  OutputOptions output_;
  std::vector<JobCommand> jobs_;
  CLI::App* job_ = nullptr;
  std::string saved_job_;
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
    return jobs::failed;
  }
}

}  // namespace ombre::cli

// ombre slice: a printable slice stack from a design.
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/text.h"
#include "compile/slice.h"
#include "ombre/arguments.h"
#include "ombre/checks.h"
#include "ombre/command_line.h"
#include "ombre/commands.h"
#include "ombre/free_space.h"
#include "ombre/job_arguments.h"
#include "ombre/progress_line.h"
#include "ombre/slice_report.h"

namespace ombre::cli {
namespace {

struct SliceArguments {
  JobArguments job;
  std::string folder, layers, memory = "2G", emit;
  int threads = 0;
  bool force = false, resume = false, dry_run = false, strict = false;
};

constexpr const char* slice_footer =
    "Lengths are millimetres and may be exact: 25.4/600 is 600 dpi.\n\n"
    "Examples:\n"
    "  ombre slice part.vcad                                0.1 mm voxels, or those of the design's root()\n"
    "  ombre slice part.vcad --printer j750 -o part/        for a printer (see: ombre printers)\n"
    "  ombre slice part.vcad --dpi 600,300 --layer-height 0.027\n"
    "  ombre slice part.vcad -D wall=1.5 -D lid=false       set variables of the design\n"
    "  ombre slice part.vcad --layers 100:110               a few layers, named as in the whole job\n"
    "  ombre slice part.vcad --dry-run                      size, memory and time; writes nothing\n"
    "  ombre slice part.vcad -o part/ --resume              go on after an interruption\n";

void add_arguments(CLI::App& app, SliceArguments& a) {
  add_job_arguments(app, a.job);
  app.add_option("-o,--output", a.folder, "Folder for the layers (default: the design's name and _slices)")
      ->type_name("DIR");
  app.add_option("--layers", a.layers, "Only these layers, a:b as in Python (b excluded), a:, :b or a")
      ->type_name("A:B");
  add_threads(app, a.threads);
  app.add_option("--memory", a.memory,
                 "Most memory for layers in flight, with their images and what evaluating them takes (default 2G)")
      ->type_name("SIZE");
  CLI::Option* force =
      app.add_flag("--force", a.force, "Replace the job in the folder, or write beside other files; those stay");
  app.add_flag("--resume", a.resume, "Continue the job in the folder")->excludes(force);
  app.add_flag("--dry-run", a.dry_run, "Say what the job would take, from a few layers; write nothing");
  app.add_flag("--strict", a.strict, "End with exit code 3 as soon as a check fails");
  app.add_option("--emit", a.emit, "Print an intermediate form to stdout, and slice nothing")
      ->check(one_of(compile::emit_forms()))
      ->type_name("FORM");
}

std::string output_folder(const SliceArguments& a) {
  if (!a.folder.empty()) return a.folder;
  return std::filesystem::path(a.job.design).stem().string() + "_slices";
}

compile::SliceOptions slice_options(const SliceArguments& a, const compile::Plan& plan) {
  compile::SliceOptions options;
  options.folder = output_folder(a);
  if (a.force) options.use = compile::FolderUse::replace;
  if (a.resume) options.use = compile::FolderUse::resume;
  options.threads = a.threads;
  options.memory_bytes = parse_memory(a.memory);
  options.strict = a.strict;
  options.stages = plan.stages;
  if (a.layers.empty()) return options;
  const int64_t count = plan.request.lattice.count[2];
  options.layers = compile::parse_layer_range(a.layers, count);
  if (!options.layers)
    throw WrongArgument("--layers " + a.layers + " selects none of the " +
                        format_count(static_cast<unsigned long long>(count)) +
                        " layers, which are 0:" + std::to_string(count) + "; write for example --layers 0:10");
  return options;
}

// The line for people, and a warning as soon as the layers to come are known to be too many for the disk.
class SliceProgress : public Progress {
 public:
  SliceProgress(const Console& console, std::string folder)
      : console_(console), folder_(std::move(folder)), line_(console) {}

  void update(const HowFar& how_far) override {
    line_.update(how_far);
    const std::string warning = warned_ ? "" : space_warning(folder_, how_far.bytes_left);
    if (warning.empty()) return;
    line_.finish();
    console_.warn(warning);
    warned_ = true;
  }
  void checking(const HowFar& how_far) override { line_.checking(how_far); }
  void preparing(const std::string& what, const HowFar& how_far) override { line_.preparing(what, how_far); }
  void finish() { line_.finish(); }

 private:
  const Console& console_;
  std::string folder_;
  ProgressLine line_;
  bool warned_ = false;
};

int dry_run(const compile::Plan& plan, const compile::SliceOptions& options, Session& session, const StopFlag& stop) {
  compile::SliceEstimate estimate;
  try {
    estimate = compile::estimate_slice(plan.request, plan.producer, options, &stop);
  } catch (const Cancelled&) {
    return interrupted;
  }
  tell_estimate(session.console, plan.request, estimate);
  const std::string warning = space_warning(options.folder, static_cast<double>(estimate.bytes));
  if (!warning.empty()) session.console.warn(warning);
  tell_checks(session.console, estimate.checks);
  return options.strict && !estimate.checks.empty() ? check_failed : done;
}

int write_slices(const compile::Plan& plan, const compile::SliceOptions& options, Session& session,
                 const StopFlag& stop) {
  SliceProgress progress(session.console, options.folder);
  try {
    const compile::SliceReport report = compile::slice(plan.request, plan.producer, options, &progress, &stop);
    progress.finish();
    tell_report(session.console, plan.request, options, report);
    tell_checks(session.console, report.checks);
    return report.stopped_by_check ? check_failed : done;
  } catch (const Cancelled&) {
    progress.finish();
    session.console.say("interrupted; the finished layers are in " + options.folder +
                        ", the same command with --resume goes on");
    session.console.event("interrupted", {{"folder", options.folder}});
    return interrupted;
  }
}

int slice(const SliceArguments& a, Session& session) {
  Diagnostics diagnostics;
  const auto diagnosed = [&] {
    session.console.diagnose(diagnostics);
    return diagnostics.has_errors() ? wrong_input : done;
  };
  auto wishes = plan_options(a.job, diagnostics);
  if (!wishes) return diagnosed();
  wishes->threads = a.threads;
  wishes->stop = &session.stop;
  wishes->memory_bytes = parse_memory(a.memory);  // a slip is better told before a long load

  const compile::LoadedPtr loaded = load_design(a.job, session, diagnostics, a.threads);
  if (!loaded) return diagnosed();
  if (const design::Node* node = a.resume || a.emit == "json" ? design::find_host_function(loaded->design) : nullptr) {
    diagnostics.error(node->where(),
                      node->type().name + " has a function of the host program, so the design can be neither " +
                          "written to a file nor resumed: nothing tells what the function is",
                      "write it as an expression");
    return diagnosed();
  }
  if (!a.emit.empty()) {
    session.console.print(compile::emit(*loaded, a.emit));
    return diagnosed();
  }
  const std::optional<compile::Plan> plan = compile::plan_slice(loaded, *wishes, diagnostics);
  if (const int code = diagnosed(); !plan || code != done) return wrong_input;

  const compile::SliceOptions options = slice_options(a, *plan);
  tell_plan(session.console, plan->request, options);
  const StopFlag& stop = session.stop;
  return a.dry_run ? dry_run(*plan, options, session, stop) : write_slices(*plan, options, session, stop);
}

}  // namespace

Command add_slice(CLI::App& program, OutputOptions& output) {
  CLI::App* app = program.add_subcommand("slice", "Write a printable slice stack: one PNG for each layer");
  auto arguments = std::make_shared<SliceArguments>();
  add_arguments(*app, *arguments);
  add_output_options(*app, output);
  app->footer(slice_footer);
  return {app, [arguments](Session& session) { return slice(*arguments, session); }};
}

}  // namespace ombre::cli

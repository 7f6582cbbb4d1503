// `ombre slice` writes a printable slice stack of a design.
#include <memory>

#include "base/text/error.h"
#include "jobs/check/emit.h"
#include "jobs/common/events.h"
#include "jobs/common/free_space.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/session.h"
#include "jobs/slice/plan_part.h"
#include "jobs/slice/slice_choices.h"
#include "jobs/slice/slice_report.h"
#include "jobs/slice/stored_slices.h"
#include "stores/open_store.h"

namespace ombre::jobs {
namespace {

using compile::SliceChoices;

constexpr const char* slice_footer =
    "Lengths are millimetres and may be exact: 25.4/600 is 600 dpi.\n\n"
    "Examples:\n"
    "  ombre slice part.vcad                                0.1 mm voxels, or those of the design's root()\n"
    "  ombre slice part.vcad --printer j750 -o part/        for a printer (see: ombre printers)\n"
    "  ombre slice part.vcad -o part.zip                    the layers as an archive\n"
    "  ombre slice part.vcad --dpi 600,300 --layer-height 0.027\n"
    "  ombre slice part.vcad -D wall=1.5 -D lid=false       set variables of the design\n"
    "  ombre slice part.vcad --layers 100:110               a few layers, named as in the whole job\n"
    "  ombre slice part.vcad --box -5,-5,0,5,5,2            a box of it, in the voxels of the whole job\n"
    "  ombre slice part.vcad --dry-run                      size, memory and time; writes nothing\n"
    "  ombre slice part.vcad -o part/ --resume              go on after an interruption\n";

// Shows the line for people, and a warning as soon as the remaining layers are known to be too many for the disk.
class SliceProgress : public Progress {
 public:
  SliceProgress(const Events& events, std::string folder)
      : events_(events), folder_(std::move(folder)), line_(events) {}

  void update(const HowFar& how_far) override {
    line_.update(how_far);
    const std::string warning = warned_ ? "" : space_warning(folder_, how_far.bytes_left);
    if (warning.empty()) return;
    line_.finish();
    events_.warn(warning);
    warned_ = true;
  }
  void checking(const HowFar& how_far) override { line_.checking(how_far); }
  void preparing(const std::string& what, const HowFar& how_far) override { line_.preparing(what, how_far); }
  void finish() { line_.finish(); }

 private:
  const Events& events_;
  std::string folder_;
  JobProgress line_;
  bool warned_ = false;
};

int dry_run(const compile::Plan& plan, const compile::SliceOptions& options, Session& session, const StopFlag& stop) {
  compile::SliceEstimate estimate;
  try {
    estimate = compile::estimate_slice(plan.request, plan.samples, options, &stop);
  } catch (const Cancelled&) {
    return interrupted;
  }
  tell_estimate(session.events, plan.request, estimate);
  const std::string warning = space_warning(options.folder, static_cast<double>(estimate.bytes));
  if (!warning.empty()) session.events.warn(warning);
  tell_checks(session.events, estimate.checks);
  return options.strict && !estimate.checks.empty() ? check_failed : done;
}

int write_slices(const compile::Plan& plan, const compile::SliceOptions& options, Session& session,
                 const StopFlag& stop) {
  SliceProgress progress(session.events, options.folder);
  try {
    const compile::SliceReport report = compile::slice(plan.request, plan.producer, options, &progress, &stop);
    progress.finish();
    tell_report(session.events, plan.request, options, report);
    tell_checks(session.events, report.checks);
    return report.stopped_by_check ? check_failed : done;
  } catch (const Cancelled&) {
    progress.finish();
    session.events.say("interrupted; the finished layers are in " + stores::pieces_folder(options.folder) +
                       ", the same command with --resume goes on");
    session.events.event("interrupted", {{"folder", options.folder}});
    return interrupted;
  }
}

// Returns nothing, and adds a diagnostic, if the design has a function that no file can hold.
compile::LoadedPtr load_sliced(const SliceChoices& a, Session& session, Diagnostics& diagnostics) {
  const compile::LoadedPtr loaded = load_design(a.design, session, diagnostics, a.work.threads);
  if (!loaded || !(a.resume || a.emit == "json")) return loaded;
  const design::Node* node = design::find_host_function(loaded->design);
  if (!node) return loaded;
  diagnostics.error(Code::option, node->where(),
                    node->type().name + " has a function of the host program, so the design can be neither " +
                        "written to a file nor resumed: nothing tells what the function is",
                    "write it as an expression");
  return nullptr;
}

int emit(const SliceChoices& a, Session& session) {
  JobSteps<compile::LoadedPtr> steps;
  steps.plan = [&](Diagnostics& diagnostics) -> std::optional<compile::LoadedPtr> {
    if (!plan_options(a.sampling, a.work, session, diagnostics, a.images)) return std::nullopt;
    const compile::LoadedPtr loaded = load_sliced(a, session, diagnostics);
    return loaded ? std::optional(loaded) : std::nullopt;
  };
  steps.run = [&](const compile::LoadedPtr& loaded) {
    session.events.print(compile::emit(*loaded, a.emit));
    return done;
  };
  return take_steps(steps, session);
}

int slice(const SliceChoices& a, Session& session) {
  if (!a.emit.empty()) return emit(a, session);
  JobSteps<compile::Plan> steps;
  steps.refuse = [&] {
    if (!a.dry_run) stores::refuse_used(a.output_folder(), a.folder_use(), compile::slice_words());
  };
  steps.plan = [&](Diagnostics& diagnostics) -> std::optional<compile::Plan> {
    auto options = plan_options(a.sampling, a.work, session, diagnostics, a.images);
    const compile::LoadedPtr loaded = options ? load_sliced(a, session, diagnostics) : nullptr;
    if (!loaded) return std::nullopt;
    JobProgress progress(session.events);
    options->progress = &progress;
    auto plan = compile::plan_slice(loaded, *options, diagnostics);
    if (!plan) return std::nullopt;
    const voxel::TileBox region = compile::chosen_region(a.box, plan->request.lattice);
    return compile::part_of(std::move(*plan), region);
  };
  steps.run = [&](const compile::Plan& plan) {
    const compile::SliceOptions options = compile::slice_options(a, plan);
    tell_plan(session.events, plan.request, options);
    return a.dry_run ? dry_run(plan, options, session, session.stop)
                     : write_slices(plan, options, session, session.stop);
  };
  return take_steps(steps, session);
}

}  // namespace

JobKind slice_kind() {
  return job_kind<SliceChoices>("slice", "Write a printable slice stack: one PNG for each layer", slice_footer, slice);
}

}  // namespace ombre::jobs

// `ombre slice` writes a printable slice stack of a design.
#include <memory>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "jobs/check/emit.h"
#include "jobs/common/events.h"
#include "jobs/common/free_space.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/session.h"
#include "jobs/quick/quick_checks.h"
#include "jobs/slice/job_description.h"
#include "jobs/slice/plan_part.h"
#include "jobs/slice/sl1_files.h"
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
    "  ombre slice part.vcad --printer prusa-sl1 -o part.sl1    masks with soft edges, for a vat printer\n"
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
    session.events.say("interrupted; the finished layers are in " + stores::pieces_folder(options.folder) + ", " +
                       (options.shard ? "the same command goes on" : "the same command with --resume goes on"));
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

// Images of .sl1 archives show the whole display, in shades of gray.
void use_sl1(const SliceChoices& a, compile::PlanOptions& options) {
  constexpr int usual_samples = 4;
  if (a.box)
    throw WrongArgument("an .sl1 archive has images of the whole display; leave out " + spelled::option("--box"));
  if (!options.whole_tray) options.place = voxel::Placement::center;
  if (!options.value) options.value = compile::ValueChoice{"coverage", {}, 8, usual_samples};
}

// Warns of what a quick look at the job finds. Voxels that need stages are left to the job.
void look(const compile::Plan& plan, const voxel::Printer& printer, Session& session) {
  const compile::SliceRequest& request = plan.request;
  warn_of_short_periods(session.events, plan.periods, request.lattice);
  if (!request.has_materials() || plan.stages->has_whole_stages()) return;
  std::map<std::string, MaterialId> materials;
  for (const compile::SliceMaterial& material : request.materials) materials.emplace(material.name, material.id);
  warn_of_neighbours(session.events, printer, materials, request.lattice, plan.samples, &session.stop);
}

std::optional<compile::Plan> plan(const SliceChoices& a, Session& session, Diagnostics& diagnostics) {
  auto options = plan_options(a.sampling, a.work, session, diagnostics, a.images);
  const compile::LoadedPtr loaded = options ? load_sliced(a, session, diagnostics) : nullptr;
  if (!loaded) return std::nullopt;
  if (!a.calibrations.apply(*options, a.design.materials, diagnostics)) return std::nullopt;
  options->finds_short_periods = !a.unchecked;
  JobProgress progress(session.events);
  options->progress = &progress;
  const bool is_sl1 = ending_of(a.output_folder()) == compile::sl1_ending;
  if (is_sl1) use_sl1(a, *options);
  auto plan = compile::plan_slice(loaded, *options, diagnostics);
  if (!plan) return std::nullopt;
  if (!a.unchecked) look(*plan, options->printer, session);
  if (is_sl1) compile::check_sl1(plan->request, {loaded->source, 0, 0}, diagnostics);
  const voxel::TileBox region = compile::chosen_region(a.box, plan->request.lattice);
  return compile::part_of(std::move(*plan), region);
}

int slice(const SliceChoices& a, Session& session) {
  if (!a.emit.empty()) return emit(a, session);
  JobSteps<compile::Plan> steps;
  steps.refuse = [&] {  // a share looks at the folder once the job is planned
    if (!a.dry_run && !a.shard) stores::refuse_used(a.output_folder(), a.folder_use(), compile::slice_words());
  };
  steps.plan = [&](Diagnostics& diagnostics) { return plan(a, session, diagnostics); };
  steps.run = [&](const compile::Plan& plan) {
    const compile::SliceOptions options = compile::slice_options(a, plan);
    tell_plan(session.events, plan.request, options);
    return a.dry_run ? dry_run(plan, options, session, session.stop)
                     : write_slices(plan, options, session, session.stop);
  };
  return take_steps(steps, session);
}

// A slice job whose layers several processes make.
class SharedSlices final : public SharedJob {
 public:
  SharedSlices(const SliceChoices& choices, compile::Plan plan)
      : plan_(std::move(plan)), options_(compile::slice_options(choices, plan_)), stored_(plan_.request) {}

  std::string folder() const override { return stores::pieces_folder(options_.folder); }
  const stores::StoredJob& stored() const override { return stored_; }
  stores::PieceRange pieces() const override {
    const auto layers = options_.layers.value_or(compile::LayerRange{0, plan_.request.lattice.count[2]});
    return {layers.begin, layers.end};
  }
  DataMembers description() const override { return compile::describe_job(plan_.request); }
  std::string difference(const DataMembers& earlier) const override {
    return compile::first_difference(earlier, description());
  }

  PieceCosts costs(Session& session) const override {
    const auto estimate = compile::estimate_slice(plan_.request, plan_.samples, options_, &session.stop);
    PieceCosts costs{{}, static_cast<double>(estimate.memory_bytes)};
    for (int64_t layer = pieces().begin; layer < pieces().end; ++layer)
      costs.seconds.push_back(estimate.costs.of({layer, layer + 1}).seconds);
    return costs;
  }

  bool has_stages() const override { return options_.stages && options_.stages->has_whole_stages(); }

  int prepare(Session& session) const override {
    if (!has_stages()) return done;
    compile::SliceOptions options = options_;
    options.use = compile::FolderUse::resume;
    options.only_stages = true;
    SliceProgress progress(session.events, options.folder);
    compile::slice(plan_.request, plan_.producer, options, &progress, &session.stop);
    progress.finish();
    session.events.say("what all shares need is kept in " + folder());
    return done;
  }

  int make(stores::PieceRange range, const stores::Shard& shard, Session& session) const override {
    compile::SliceOptions options = options_;
    options.layers = compile::LayerRange{range.begin, range.end};
    options.shard = shard;
    return write_slices(plan_, options, session, session.stop);
  }

  int join(Session& session) const override {
    compile::SliceOptions options = options_;
    options.use = compile::FolderUse::resume;
    return write_slices(plan_, options, session, session.stop);
  }

 private:
  compile::Plan plan_;
  compile::SliceOptions options_;
  compile::StoredSlices stored_;
};

SharedJobPtr share(const void* job, Session& session, Diagnostics& diagnostics) {
  const auto& choices = *static_cast<const SliceChoices*>(job);
  if (choices.shard || choices.force || choices.dry_run || !choices.emit.empty())
    throw WrongArgument("a job that is shared out has none of " + spelled::option("--shard") + ", " +
                        spelled::option("--force") + ", " + spelled::option("--dry-run") + " and " +
                        spelled::option("--emit"));
  auto planned = plan(choices, session, diagnostics);
  if (!planned || diagnostics.has_errors()) return nullptr;
  return std::make_unique<SharedSlices>(choices, std::move(*planned));
}

}  // namespace

JobKind slice_kind() {
  JobKind kind =
      job_kind<SliceChoices>("slice", "Write a printable slice stack: one PNG for each layer", slice_footer, slice);
  kind.share = share;
  return kind;
}

}  // namespace ombre::jobs

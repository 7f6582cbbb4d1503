// `ombre resolve` says how a design's properties become what printers need, and what the printers give.
#include <algorithm>

#include "base/text/text.h"
#include "design/design_file.h"
#include "export/output_file.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/resolve/resolve_choices.h"
#include "jobs/resolve/resolve_report.h"
#include "load/node_registry.h"
#include "questions/build.h"

namespace ombre::jobs {
namespace {

using compile::ResolveChoices;

constexpr const char* resolve_footer =
    "A design asks for properties by attributes, such as modulus. Calibrations say which mixtures of materials, or\n"
    "settings of a machine, have them. The report compares what is asked for with what calibrations expect. The exit\n"
    "code is 3 if some of the part is out of reach, unless --out-of-reach nearest allows it.\n\n"
    "Examples:\n"
    "  ombre resolve part.vcad --printer j750 --materials materials/j750.json\n"
    "  ombre resolve part.vcad --printer j750 --printer fff-foaming-pla --report report.html\n"
    "  ombre resolve part.vcad --printer fff-foaming-pla -o resolved.json\n";

struct ResolvePlan {
  compile::LoadedPtr loaded;
  Box box;
  std::vector<compile::PlanOptions> options;  // of each printer
};

std::optional<ResolvePlan> plan(const ResolveChoices& a, Session& session, Diagnostics& diagnostics) {
  ResolvePlan plan;
  for (const std::string& printer : a.printers.empty() ? std::vector<std::string>{""} : a.printers) {
    compile::SamplingOptions sampling;
    sampling.printer = printer;
    sampling.voxel = a.voxel;
    auto options = plan_options(sampling, a.work, session, diagnostics);
    if (!options || !a.calibrations.apply(*options, a.design.materials, diagnostics)) return std::nullopt;
    plan.options.push_back(std::move(*options));
  }
  plan.loaded = load_design(a.design, session, diagnostics, a.work.threads);
  const auto box = plan.loaded ? compile::design_box(plan.loaded->design, diagnostics) : std::nullopt;
  if (!box) return std::nullopt;
  plan.box = *box;
  return plan;
}

voxel::Lattice lattice_of(const ResolvePlan& plan, const compile::PlanOptions& options) {
  voxel::Lattice lattice;
  lattice.origin = plan.box.lo;
  lattice.pitch = options.printer.pitch;
  const auto& sampling = plan.loaded->design.sampling;
  if (sampling && !options.printer_given) lattice.pitch = sampling->pitch;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (options.pitch[axis]) lattice.pitch[axis] = *options.pitch[axis];
    lattice.count[axis] = voxel::voxels_along(plan.box.size()[static_cast<int>(axis)], lattice.pitch[axis]);
  }
  return lattice;
}

bool gives_dose(const design::Design& design) {
  const std::vector<std::string> given = compile::given_quantities(design);
  return std::ranges::find(given, "dose") != given.end();
}

// Resolves the design for one printer. Returns nothing, and adds diagnostics, if that is impossible.
std::optional<ResolvedPart> resolved_part(const ResolvePlan& plan, const compile::PlanOptions& options,
                                          const ResolveChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto calibrations = compile::load_calibrations(options.resolving->calibrations, diagnostics);
  if (!calibrations) return std::nullopt;
  const compile::Needs needs{options.printer.needs, options.printer.steps, options.resolving->deciding};
  auto resolution = compile::resolve(plan.loaded, *calibrations, needs, diagnostics);
  if (!resolution) return std::nullopt;
  const compile::StageLoan loan{a.work.threads, a.work.memory_bytes, nullptr, &session.stop};
  const compile::IntentQuery query{*resolution, *calibrations, options.printer.needs, loan};
  const voxel::Lattice lattice = lattice_of(plan, options);
  auto report = compile::survey_intent(plan.loaded->design, query, compile::coarse_lattice(lattice), diagnostics);
  if (!report) return std::nullopt;
  ResolvedPart part{options.printer.name, options.printer.title, "", std::move(*resolution), std::move(*report)};
  const design::Design& resolved = part.resolution.loaded->design;
  const calibration::Calibration* const curve = compile::working_curve_among(*calibrations);
  if (!options.printer.is_vat || !curve || !gives_dose(resolved)) return part;
  part.cure = compile::survey_cure(resolved, *curve, compile::columns_of(lattice), loan, diagnostics);
  return part.cure ? std::optional(std::move(part)) : std::nullopt;
}

void write_files(const ResolveChoices& a, const std::vector<ResolvedPart>& parts, const Session& session) {
  if (!a.output.empty()) {
    const Data design = design::to_data(parts.front().resolution.loaded->design);
    exporting::write_file(a.output, design::design_text(design, compile::node_registry(), a.output));
    session.events.say("wrote " + a.output);
  }
  if (!a.report.file.empty()) {
    exporting::write_file(a.report.file, resolved_page(a.design.design, parts));
    session.events.say("wrote " + a.report.file);
  }
}

int run(const ResolveChoices& a, const ResolvePlan& plan, Session& session) {
  std::vector<ResolvedPart> parts;
  for (const compile::PlanOptions& options : plan.options) {
    Diagnostics diagnostics;
    auto part = resolved_part(plan, options, a, session, diagnostics);
    if (!part && plan.options.size() > 1) {
      const auto& list = diagnostics.list();
      const auto error = std::ranges::find(list, Severity::error, &Diagnostic::severity);
      parts.push_back({options.printer.name, options.printer.title, error->message, {}, {}});
      continue;
    }
    session.events.diagnose(diagnostics);
    if (!part) return wrong_input;
    parts.push_back(std::move(*part));
  }
  tell_resolved(session.events, parts);
  write_files(a, parts, session);
  const bool takes_nearest = a.calibrations.out_of_reach == compile::OutOfReachRule::nearest;
  return takes_nearest || std::ranges::all_of(parts, is_reached) ? done : check_failed;
}

void check_choices(const ResolveChoices& a) {
  if (!a.output.empty() && a.printers.size() > 1)
    throw WrongArgument("-o writes the design for one printer; give one " + spelled::option("--printer"));
  if (!a.output.empty()) check_design_file(a.output);
  for (const std::string& file : {a.output, a.report.file})
    if (!file.empty()) refuse_to_overwrite(file, a.report.force);
}

int resolve(const ResolveChoices& a, Session& session) {
  JobSteps<ResolvePlan> steps;
  steps.refuse = [&] { check_choices(a); };
  steps.plan = [&](Diagnostics& diagnostics) { return plan(a, session, diagnostics); };
  steps.run = [&](const ResolvePlan& plan) { return run(a, plan, session); };
  return take_steps(steps, session);
}

}  // namespace

JobKind resolve_kind() {
  return job_kind<ResolveChoices>("resolve", "Say how a design's properties become materials and settings of printers",
                                  resolve_footer, resolve);
}

}  // namespace ombre::jobs

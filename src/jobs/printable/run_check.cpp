// `ombre check` says whether a printer can make a part as it is meant.
#include <algorithm>
#include <set>

#include "base/text/error.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/printable/check_choices.h"
#include "jobs/printable/fix_job.h"
#include "jobs/printable/print_report.h"
#include "jobs/quick/quick_checks.h"
#include "jobs/slice/slice_report.h"
#include "jobs/slice/stored_slices.h"
#include "stores/open_store.h"

namespace ombre::jobs {
namespace {

using compile::CheckChoices;

constexpr const char* check_footer =
    "It makes the voxels of the job, and looks for walls and gaps that are too thin, materials that may not be\n"
    "neighbours, islands and overhangs, cups, closed hollows and loose bodies. The limits are those of the printer's\n"
    "profile. The exit code is 3 if something stands in the way; warnings alone do not change it.\n\n"
    "Examples:\n"
    "  ombre check part.vcad --printer j750\n"
    "  ombre check part.vcad --voxel 0.05 --details 0.3 --report check.html\n"
    "  ombre check part.vcad --printer j750 --fix part_fixed --drop 0.5\n";

struct CheckPlan {
  compile::LoadedPtr loaded;
  compile::Plan slices;
  compile::CheckLimits limits;
  std::string printer;
  bool may_grow = true;  // the layers do not cover a tray
};

compile::CheckLimits limits_of(const CheckChoices& a, const voxel::Printer& printer,
                               const design::MaterialTable& materials) {
  compile::CheckLimits limits{printer.smallest_feature, printer.forbidden_neighbours, a.each_material};
  if (a.details_mm) limits.details = voxel::SmallestFeature{0, *a.details_mm};
  limits.overhang_degrees = a.overhang_degrees ? a.overhang_degrees : printer.overhang_degrees;
  limits.is_vat = printer.is_vat;
  if (const design::Material* support = materials.support()) limits.support = support->name;
  return limits;
}

std::optional<CheckPlan> plan(const CheckChoices& a, Session& session, Diagnostics& diagnostics) {
  auto options = plan_options(a.sampling, a.work, session, diagnostics);
  if (!options || !a.calibrations.apply(*options, a.design.materials, diagnostics)) return std::nullopt;
  options->finds_short_periods = true;
  const auto loaded = load_design(a.design, session, diagnostics, a.work.threads);
  auto slices = loaded ? compile::plan_slice(loaded, *options, diagnostics) : std::nullopt;
  if (!slices) return std::nullopt;
  warn_of_short_periods(session.events, slices->periods, slices->request.lattice);
  const bool on_tray =
      options->whole_tray || options->place.value_or(options->printer.origin) == voxel::Placement::center;
  return CheckPlan{loaded, std::move(*slices), limits_of(a, options->printer, loaded->design.materials),
                   options->printer.title, !on_tray};
}

// Returns what the printer's profile leaves open.
std::vector<std::string> unchecked(const compile::CheckLimits& limits, const std::string& printer) {
  std::vector<std::string> sentences;
  if (!limits.details)
    sentences.push_back("walls and gaps, since " + printer + " has no smallest feature; " +
                        std::string("--details gives one"));
  return sentences;
}

bool stand_in_the_way(const std::vector<compile::PrintFinding>& findings) {
  return std::ranges::any_of(findings, &compile::PrintFinding::is_error);
}

bool has_kind(const std::vector<compile::PrintFinding>& findings, const std::string& kind) {
  return std::ranges::find(findings, kind, &compile::PrintFinding::kind) != findings.end();
}

// Names of materials that rules of the job's limits are about.
std::set<std::string> ruled_materials(const compile::CheckLimits& limits) {
  std::set<std::string> names;
  for (const voxel::ForbiddenNeighbour& rule : limits.neighbours) names.insert({rule.material, rule.near});
  return names;
}

// Returns the material of shells between forbidden neighbours. Throws WrongArgument if it is not clear, or if a rule is
// about it.
compile::SliceMaterial neutral_material(const CheckChoices& a, const CheckPlan& planned) {
  const std::set<std::string> ruled = ruled_materials(planned.limits);
  std::vector<compile::SliceMaterial> free;
  for (const compile::SliceMaterial& material : planned.slices.request.materials)
    if (!ruled.contains(material.name) && material.name != planned.limits.support) free.push_back(material);
  if (a.neutral.empty() && free.size() == 1) return free.front();
  const Phrase hint = "write " + spelled::option("--neutral", "NAME") + " with a material that no rule of " +
                      planned.printer + " names";
  if (a.neutral.empty()) {
    std::vector<std::string> names;
    for (const compile::SliceMaterial& material : free) names.push_back(material.name);
    throw WrongArgument(
        (names.empty() ? "the design has no material that may lie" : join(names, " and ") + " may lie") +
        " between forbidden neighbours; " + hint);
  }
  const design::Material* const material = planned.loaded->design.materials.find(a.neutral);
  if (!material || material->id == 0) throw WrongArgument("there is no material \"" + a.neutral + "\"; " + hint);
  if (ruled.contains(material->name))
    throw WrongArgument("a rule of " + planned.printer + " is about \"" + material->name + "\"; " + hint);
  return {material->name, material->id, material->colour};
}

void add_material(compile::SliceMaterial material, std::vector<compile::SliceMaterial>& materials) {
  if (std::ranges::find(materials, material.id, &compile::SliceMaterial::id) != materials.end()) return;
  materials.push_back(std::move(material));
  std::ranges::sort(materials, {}, &compile::SliceMaterial::id);
}

// Corrects what was found, says what that changes and what is left, and writes the layers. Returns an exit code.
int fix(const CheckChoices& a, const CheckPlan& planned, const std::vector<compile::PrintCheck>& checks,
        const std::vector<compile::PrintFinding>& findings, const compile::CheckRun& how, Session& session) {
  compile::Plan before = planned.slices;
  compile::FixRules rules;
  rules.drop_below_mm3 = a.drop_mm3.value_or(0);
  rules.support = compile::id_of(before.request, planned.limits.support);
  rules.may_grow = planned.may_grow;
  if (has_kind(findings, "hollow")) rules.drain_mm = a.drain_mm.value_or(0);
  if (const auto& details = planned.limits.details; details && has_kind(findings, "thin"))
    rules.thick_mm = std::max(details->distorts_mm, details->fails_mm);
  if (has_kind(findings, "neighbour")) {
    const compile::SliceMaterial neutral = neutral_material(a, planned);
    rules.neutral = neutral.id;
    add_material(neutral, before.request.materials);
  }
  compile::CorrectedJob corrected = compile::correct_job(before, checks, rules, how);
  compile::Plan& after = corrected.plan;
  after.request.corrections = describe(corrected.corrections, after.request);
  tell_corrections(session.events, corrected.corrections, after.request);
  if (corrected.hollows_left > 0)
    session.events.say(std::to_string(corrected.hollows_left) +
                       " closed hollows have no straight way outside along x, y or z, and stay; turn the part");
  const CheckedPart part{
      a.design.design + " with these corrections", planned.printer, compile::run_print_checks(after, checks, how), {}};
  tell_findings(session.events, part, after.request.lattice);
  compile::SliceOptions options;
  options.folder = a.fix;
  options.use = a.report.force ? compile::FolderUse::replace : compile::FolderUse::fresh;
  options.threads = a.work.threads;
  options.memory_bytes = a.work.memory_bytes;
  options.stages = after.stages;
  const compile::SliceReport report =
      compile::slice(after.request, after.producer, options, how.progress, &session.stop);
  tell_report(session.events, after.request, options, report);
  return stand_in_the_way(part.findings) ? check_failed : done;
}

int run(const CheckChoices& a, const CheckPlan& planned, Session& session) {
  const compile::Plan& slices = planned.slices;
  const voxel::Lattice& lattice = slices.request.lattice;
  JobProgress progress(session.events);
  slices.stages->prepare({a.work.threads, a.work.memory_bytes, &progress, &session.stop});
  const auto checks = compile::print_checks(planned.limits, slices.request);
  const compile::CheckRun how{a.work.threads, a.work.memory_bytes, &progress, &session.stop};
  const CheckedPart part{a.design.design, planned.printer, compile::run_print_checks(slices, checks, how),
                         unchecked(planned.limits, planned.printer)};
  progress.finish();
  tell_findings(session.events, part, lattice);
  if (!a.report.file.empty()) {
    exporting::write_file(a.report.file, findings_page(part, slices, &session.stop));
    session.events.say("wrote " + a.report.file);
  }
  if (!a.fix.empty()) return fix(a, planned, checks, part.findings, how, session);
  return stand_in_the_way(part.findings) ? check_failed : done;
}

int check(const CheckChoices& a, Session& session) {
  if (!a.fix.empty())
    stores::refuse_used(a.fix, a.report.force ? compile::FolderUse::replace : compile::FolderUse::fresh,
                        compile::slice_words());
  return take_report_steps<CheckPlan>(a, session, plan, run);
}

}  // namespace

JobKind check_kind() {
  return job_kind<CheckChoices>("check", "Say whether a printer can make a part as it is meant", check_footer, check);
}

}  // namespace ombre::jobs

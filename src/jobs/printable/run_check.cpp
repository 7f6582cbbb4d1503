// `ombre check` says whether a printer can make a part as it is meant.
#include <algorithm>

#include "export/output_file.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/printable/check_choices.h"
#include "jobs/printable/print_report.h"
#include "jobs/slice/slice_report.h"

namespace ombre::jobs {
namespace {

using compile::CheckChoices;

constexpr const char* check_footer =
    "It makes the voxels of the job, and looks for walls and gaps that are too thin, materials that may not be\n"
    "neighbours, closed hollows and loose bodies. The limits are those of the printer's profile. The exit code is 3 "
    "if\n"
    "something stands in the way; warnings alone do not change it.\n\n"
    "Examples:\n"
    "  ombre check part.vcad --printer j750\n"
    "  ombre check part.vcad --voxel 0.05 --details 0.3 --report check.html\n";

struct CheckPlan {
  compile::Plan slices;
  compile::CheckLimits limits;
  std::string printer;
};

compile::CheckLimits limits_of(const CheckChoices& a, const voxel::Printer& printer) {
  compile::CheckLimits limits{printer.smallest_feature, printer.forbidden_neighbours, a.each_material};
  if (a.details_mm) limits.details = voxel::SmallestFeature{0, *a.details_mm};
  return limits;
}

std::optional<CheckPlan> plan(const CheckChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto options = plan_options(a.sampling, a.work, session, diagnostics);
  if (!options) return std::nullopt;
  const auto loaded = load_design(a.design, session, diagnostics, a.work.threads);
  auto slices = loaded ? compile::plan_slice(loaded, *options, diagnostics) : std::nullopt;
  if (!slices) return std::nullopt;
  return CheckPlan{std::move(*slices), limits_of(a, options->printer), options->printer.title};
}

// Returns what the printer's profile leaves open.
std::vector<std::string> unchecked(const compile::CheckLimits& limits, const std::string& printer) {
  std::vector<std::string> sentences;
  if (!limits.details)
    sentences.push_back("walls and gaps, since " + printer + " has no smallest feature; " +
                        std::string("--details gives one"));
  return sentences;
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
  return std::ranges::any_of(part.findings, &compile::PrintFinding::is_error) ? check_failed : done;
}

int check(const CheckChoices& a, Session& session) { return take_report_steps<CheckPlan>(a, session, plan, run); }

}  // namespace

JobKind check_kind() {
  return job_kind<CheckChoices>("check", "Say whether a printer can make a part as it is meant", check_footer, check);
}

}  // namespace ombre::jobs

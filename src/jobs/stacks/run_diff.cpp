// `ombre diff` says what changes between two designs or stacks.
#include "export/output_file.h"
#include "jobs/common/job_design.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/job_steps.h"
#include "jobs/common/overwrite.h"
#include "jobs/stacks/diff_report.h"

namespace ombre::jobs {
namespace {

using compile::ComparedSource;
using compile::DiffChoices;

constexpr const char* diff_footer =
    "Both are compared on one grid of voxels, material by material. A design beside a stack takes the stack's grid,\n"
    "dither and seed. Of two stacks that show values, such as doses, it says where these differ and by how much. The "
    "exit code is 0 if there is no difference, and 3 if there is one.\n\n"
    "Examples:\n"
    "  ombre diff part.vcad part_v2.vcad --voxel 0.1\n"
    "  ombre diff part_slices part.vcad\n"
    "  ombre diff monday_slices tuesday_slices --report changes.html\n";

struct DiffPlan {
  compile::CommonLattice common;
  compile::ComparedSolid first, second;
  std::optional<std::array<compile::ComparedValues, 2>> values;  // in place of solids, of stacks that show values
};

bool shows_values(const ComparedSource& source) { return source.stack && !source.stack->request().has_materials(); }

std::optional<ComparedSource> source(const std::string& path, const DiffChoices& a, Session& session,
                                     Diagnostics& diagnostics) {
  if (compile::is_stack(path)) return compile::compared_stack(path);
  DesignArguments design;
  design.design = path;
  design.materials = a.materials;
  design.definitions = a.definitions;
  const auto loaded = load_design(design, session, diagnostics, a.work.threads);
  return loaded ? compile::compared_design(loaded, diagnostics) : std::nullopt;
}

// Warns of what the comparison cannot tell.
void warn_of_limits(const ComparedSource& source, const Events& events) {
  if (!source.stack) return;
  if (!source.stack->job.is_complete) events.warn(source.path + " is unfinished, so its layers may be missing");
  if (shows_values(source)) return;
  const compile::Appearance appearance(source.stack->request());
  if (!appearance.hidden().empty())
    events.warn("the images of " + source.path + " do not tell all materials apart, or from void; these take part as " +
                "what they look like");
}

std::optional<DiffPlan> plan(const DiffChoices& a, Session& session, Diagnostics& diagnostics) {
  const auto first = source(a.first, a, session, diagnostics), second = source(a.second, a, session, diagnostics);
  if (!first || !second) return std::nullopt;
  const bool has_values = shows_values(*first) || shows_values(*second);
  if (has_values) compile::check_same_channels(*first, *second);
  warn_of_limits(*first, session.events);
  warn_of_limits(*second, session.events);
  const compile::CheckWork work{a.work.threads, a.work.memory_bytes, nullptr, &session.stop};
  DiffPlan planned{compile::common_lattice(*first, *second, a.voxel.value_or(options::Pitches{})), {}, {}, {}};
  const voxel::Lattice& lattice = planned.common.sampling.lattice;
  if (has_values) {
    planned.values = {compile::compared_values(first->stack, lattice),
                      compile::compared_values(second->stack, lattice)};
    return planned;
  }
  auto solid_a = compile::compared_solid(*first, planned.common, work, diagnostics);
  auto solid_b = compile::compared_solid(*second, planned.common, work, diagnostics);
  if (!solid_a || !solid_b) return std::nullopt;
  if (!planned.common.keeps_draws)
    session.events.warn("the grid is not that of the stack, so that voxels of mixtures are drawn anew and differ");
  planned.first = std::move(*solid_a);
  planned.second = std::move(*solid_b);
  return planned;
}

// Compares both and tells what changes. `page` makes the page of the report.
template <class Compare, class Page>
int compare(const DiffChoices& a, const voxel::Lattice& lattice, Session& session, const Compare& compare,
            const Page& page) {
  JobProgress progress(session.events, Counted::steps);
  const compile::CheckWork work{a.work.threads, a.work.memory_bytes, &progress, &session.stop};
  const auto changes = compare(compile::fitting(work, lattice));
  progress.finish();
  tell_changes(session.events, changes, lattice);
  if (!a.report.file.empty()) {
    exporting::write_file(a.report.file, page(changes));
    session.events.say("wrote " + a.report.file);
  }
  return changes.layers.empty() ? done : check_failed;
}

int run(const DiffChoices& a, const DiffPlan& planned, Session& session) {
  const voxel::Lattice& lattice = planned.common.sampling.lattice;
  using compile::CheckWork;
  if (planned.values) {
    const compile::ComparedValues &first = planned.values->front(), &second = planned.values->back();
    return compare(
        a, lattice, session,
        [&](const CheckWork& work) { return compile::value_changes(first, second, lattice, work); },
        [&](const compile::ValueChanges& changes) { return changes_page(a, changes, first, second, lattice); });
  }
  const auto &first = planned.first, &second = planned.second;
  return compare(
      a, lattice, session,
      [&](const CheckWork& work) { return compile::material_changes(first, second, lattice, work); },
      [&](const compile::MaterialChanges& changes) { return changes_page(a, changes, first, second, lattice); });
}

int diff(const DiffChoices& a, Session& session) { return take_report_steps<DiffPlan>(a, session, plan, run); }

}  // namespace

JobKind diff_kind() {
  return job_kind<DiffChoices>("diff", "Say what changes between two designs or slice stacks", diff_footer, diff);
}

}  // namespace ombre::jobs

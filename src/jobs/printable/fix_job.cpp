#include "jobs/printable/fix_job.h"

#include "base/text/text.h"
#include "jobs/printable/drains.h"

namespace ombre::compile {
namespace {

// Makes corrections one after the other, each of what the earlier ones give.
class JobFixer {
 public:
  JobFixer(const Plan& plan, const CheckRun& run) : job_{plan, {}, 0}, run_(run) {}

  const Plan& plan() const { return job_.plan; }
  void apply(const std::string& kind, const std::string& text, VoxelChanges found) {
    if (found.is_empty()) return;
    const auto changes = std::make_shared<const VoxelChanges>(std::move(found));
    job_.corrections.push_back({kind, text, gained_voxels(plan(), *changes, run_)});
    job_.plan = changed_plan(plan(), changes);
  }
  // Opens hollows, and then those that lay within them.
  void drain(const DrainRules& rules) {
    for (;;) {
      Drains drains = open_hollows(plan(), rules, run_);
      job_.hollows_left = drains.left;
      if (drains.opened == 0) return;
      apply("drain",
            "opened " + std::to_string(drains.opened) +
                (drains.opened == 1 ? " closed hollow by a channel" : " closed hollows by channels") + " of " +
                format_rounded(rules.diameter_mm) + " mm",
            std::move(drains.changes));
    }
  }
  CorrectedJob finish() { return std::move(job_); }

 private:
  CorrectedJob job_;
  const CheckRun& run_;
};

}  // namespace

CorrectedJob correct_job(const Plan& plan, const std::vector<PrintCheck>& checks, const FixRules& rules,
                         const CheckRun& run) {
  JobFixer fixer(plan, run);
  if (rules.drop_below_mm3 > 0)
    fixer.apply("drop", "removed loose bodies below " + format_rounded(rules.drop_below_mm3) + " mm3",
                drop_loose_bodies(fixer.plan(), rules.drop_below_mm3, rules.support, run));
  if (rules.thick_mm > 0)
    fixer.apply("thicken", "thickened walls and details to " + format_rounded(rules.thick_mm) + " mm",
                thicken(fixer.plan(), rules.thick_mm, rules.may_grow, run));
  if (rules.neutral != 0)
    fixer.apply("keep-apart", "put a shell between materials that may not be neighbours",
                keep_apart(fixer.plan(), checks, rules.neutral, run));
  if (rules.drain_mm > 0) fixer.drain({rules.drain_mm, rules.support});
  return fixer.finish();
}

}  // namespace ombre::compile

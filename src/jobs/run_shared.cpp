// Commands for jobs that several processes share: plan, run, status, gather.
#include <cmath>
#include <filesystem>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/containers/file.h"
#include "jobs/all_jobs.h"
#include "jobs/common/events.h"
#include "jobs/common/job_kind.h"
#include "jobs/common/overwrite.h"
#include "jobs/common/pace.h"
#include "jobs/common/run_reported.h"
#include "jobs/shared_plan.h"
#include "mpi/ranks.h"
#include "options/members.h"

namespace ombre::jobs {
namespace {

using stores::PieceRange;

constexpr const char* plan_footer =
    "JOB is a file that --save-job wrote. The plan says which pieces belong to which share, so that each takes about "
    "as\n"
    "long as the others. Pieces are layers of slice, slabs of voxels and of mesh, frames of render, cases of sweep,\n"
    "and the designs that optimise measures next. Any machine with the plan, the design and its files, and the\n"
    "folder of the job may run a share.\n\n"
    "Examples:\n"
    "  ombre slice part.vcad --printer j750 -o part/ --save-job job.json\n"
    "  ombre plan job.json --shards 40            plan.json\n"
    "  ombre run plan.json --shard 3              the third share; again after an interruption\n"
    "  seq 40 | parallel ombre run plan.json --shard {}\n"
    "  mpirun -n 8 --bind-to none ombre run plan.json          each process takes the next share when it is free\n"
    "  ombre submit plan.json --to slurm          all of them, in a job array\n"
    "  ombre status plan.json\n"
    "  ombre gather plan.json                     one finished job of all shares\n";

struct PlanChoices {
  std::string job, output = "plan.json";
  std::optional<int> shards;
  std::optional<double> minutes;
  bool force = false;

  static const options::Spec<PlanChoices>& options() {
    using namespace options;
    static const options::Spec<PlanChoices> spec{
        option("job", &PlanChoices::job, kind::file, "The job: a file that --save-job wrote", "JOB").required(),
        option("--shards", &PlanChoices::shards, kind::whole, "The number of shares", "N")
            .between(1, static_cast<double>(stores::most_shards)),
        option("--minutes", &PlanChoices::minutes, kind::number,
               "As many shares as take about this time each on all cores of this machine; minutes", "MINUTES")
            .excludes({"--shards"})
            .between(0.01, 1e6),
        option("-o,--output", &PlanChoices::output, kind::file, "The plan to write (default: plan.json)", "FILE"),
        flag("--force", &PlanChoices::force, "Replace an existing plan")};
    return spec;
  }
};

struct RunChoices {
  std::string plan, shard;
  bool only_stages = false;

  static const options::Spec<RunChoices>& options() {
    using namespace options;
    static const options::Spec<RunChoices> spec{
        option("plan", &RunChoices::plan, kind::file, "The plan: a file that ombre plan wrote", "PLAN").required(),
        option("--shard", &RunChoices::shard, kind::text,
               "The share: 3, 3/40, or all, one after the other (default: that of the job array or MPI process)", "N"),
        flag("--stages", &RunChoices::only_stages,
             "Instead of a share, make what all shares need, such as supports, so that each does not")
            .excludes({"--shard"})};
    return spec;
  }
};

struct StatusChoices {
  std::string plan;

  static const options::Spec<StatusChoices>& options() {
    using namespace options;
    static const options::Spec<StatusChoices> spec{
        option("plan", &StatusChoices::plan, kind::file, "The plan: a file that ombre plan wrote", "PLAN").required()};
    return spec;
  }
};

// Returns "slice, render" and so on.
std::string shared_kinds() {
  std::vector<std::string> names;
  for (const JobKind& kind : all_jobs())
    if (kind.share) names.push_back(kind.name);
  return words_text(names);
}

SharedJobPtr share(const SavedJob& saved, Session& session, Diagnostics& diagnostics) {
  if (!saved.kind->share)
    throw WrongArgument("jobs of the kind " + saved.kind->name + " have no pieces that could be shared out; those of " +
                        shared_kinds() + " have, and ombre sweep makes cases of any job");
  const std::shared_ptr<void> job = saved.kind->make();
  options::read_members(saved.kind->options(), job.get(), saved.options);
  return saved.kind->share(job.get(), session, diagnostics);
}

// A plan with the job that it is of, planned again here.
struct Opened {
  SharedPlan plan;
  SharedJobPtr job;

  int64_t count() const { return static_cast<int64_t>(plan.shards.size()); }
  PieceRange pieces() const { return {plan.shards.front().begin, plan.shards.back().end}; }
};

// Throws Error if the job here is not the one that was planned. Returns nothing, and reports it, if it is wrong.
std::optional<Opened> open_plan(const std::string& path, Session& session) {
  Diagnostics diagnostics;
  auto plan = read_plan(make_source(path, formats::read_file(path)), diagnostics);
  SharedJobPtr job = plan ? share(plan->job, session, diagnostics) : nullptr;
  session.events.diagnose(diagnostics);
  if (!job) return std::nullopt;
  const std::string difference = job->difference(plan->describes);
  const PieceRange planned{plan->shards.front().begin, plan->shards.back().end};
  if (!difference.empty() || planned != job->pieces())
    throw Error(Code::other_job,
                path + " is the plan of another job: " + (difference.empty() ? "its pieces are others" : difference) +
                    "; make it anew: ombre plan",
                {{"file", path}});
  return Opened{std::move(*plan), std::move(job)};
}

int64_t count_for(const PlanChoices& a, const std::vector<double>& costs) {
  if (a.shards) return *a.shards;
  if (!a.minutes) throw WrongArgument("how many shares? write for example --shards 40 or --minutes 20");
  constexpr double seconds_in_minute = 60;
  double seconds = 0;
  for (const double cost : costs) seconds += cost;
  if (seconds == 0) throw WrongArgument("how long this job takes is not known; write for example --shards 40");
  const double count = std::ceil(seconds / (core_count() * *a.minutes * seconds_in_minute));
  return static_cast<int64_t>(std::clamp(count, 1.0, static_cast<double>(std::max<size_t>(costs.size(), 1))));
}

int plan(const PlanChoices& a, Session& session) {
  if (!a.shards && !a.minutes) (void)count_for(a, {});
  refuse_to_overwrite(a.output, a.force);
  Diagnostics diagnostics;
  auto saved = read_saved_job(make_source(a.job, formats::read_file(a.job)), diagnostics);
  const SharedJobPtr job = saved ? share(*saved, session, diagnostics) : nullptr;
  session.events.diagnose(diagnostics);
  if (!job) return wrong_input;
  const PieceCosts costs = job->costs(session);
  const SharedPlan made = plan_of(std::move(*saved), *job, costs, count_for(a, costs.seconds));
  exporting::write_file(a.output, plan_text(made, session.program));
  session.events.say(format_count(made.shards.size()) + " shares of " + format_count(costs.seconds.size()) + " " +
                     job->stored().words().pieces + " are in " + a.output + "; ombre run " + a.output +
                     " --shard 1 does the first");
  session.events.event("shared_plan",
                       {{"file", a.output}, {"shards", number(static_cast<int64_t>(made.shards.size()))}});
  return done;
}

int make_share(const Opened& opened, int64_t number, Session& session) {
  const PieceRange range = opened.plan.shards[static_cast<size_t>(number - 1)];
  return opened.job->make(range, {number, opened.count()}, session);
}

// Makes shares as a process of MPI that takes the next one whenever it is free. A share that fails does not keep the
// process from the others. Returns nothing if this build cannot do that.
std::optional<int> make_next_shares(const Opened& opened, int64_t processes, Session& session) {
  int code = done;
  const auto make = [&](int64_t number) {
    const int made = run_reported(session.events, [&] { return make_share(opened, number + 1, session); });
    if (made != done) code = made;
    return made != interrupted;
  };
  return mpi::take_numbers(opened.count(), processes, make) ? std::optional(code) : std::nullopt;
}

int run(const RunChoices& a, Session& session) {
  const auto opened = open_plan(a.plan, session);
  if (!opened) return wrong_input;
  if (a.only_stages) return opened->job->prepare(session);
  if (const int64_t processes = a.shard.empty() ? mpi_processes() : 0; processes > 1)
    if (const auto code = make_next_shares(*opened, processes, session)) return *code;
  for (const int64_t number : chosen_shards(a.shard, opened->count()))
    if (const int code = make_share(*opened, number, session); code != done) return code;
  return done;
}

std::string range_text(PieceRange range) { return std::to_string(range.begin) + ":" + std::to_string(range.end); }

stores::Gathered gathered(const Opened& opened, Session& session) {
  JobProgress progress(session.events);
  return stores::gather(opened.job->folder(), opened.job->stored(), opened.pieces(), {0, &progress, &session.stop});
}

// Returns the pieces of a share that are missing.
int64_t missing_in(PieceRange shard, const stores::Gathered& all) {
  int64_t missing = 0;
  for (const PieceRange& gap : all.gaps)
    missing += std::max<int64_t>(0, std::min(shard.end, gap.end) - std::max(shard.begin, gap.begin));
  return missing;
}

int status(const StatusChoices& a, Session& session) {
  const auto opened = open_plan(a.plan, session);
  if (!opened) return wrong_input;
  stores::Gathered all;
  if (std::filesystem::exists(opened->job->folder()))
    all = gathered(*opened, session);
  else
    all.gaps = {opened->pieces()};
  const std::string& pieces = opened->job->stored().words().pieces;
  int64_t number_of = 0, finished = 0;
  for (const PieceRange& shard : opened->plan.shards) {
    const int64_t count = shard.end - shard.begin, missing = missing_in(shard, all);
    ++number_of;
    if (missing == 0) ++finished;
    session.events.event("share", {{"number", number(number_of)},
                                   {"pieces", DataList{number(shard.begin), number(shard.end)}},
                                   {"missing", number(missing)}});
    if (missing > 0)
      session.events.say("share " + std::to_string(number_of) + ": " + std::to_string(count - missing) + " of " +
                         std::to_string(count) + " " + pieces + ", " + range_text(shard));
  }
  session.events.say(std::to_string(finished) + " of " + std::to_string(opened->count()) + " shares are done" +
                     (finished == opened->count() ? "; ombre gather " + a.plan + " joins them" : ""));
  return done;
}

int gather(const StatusChoices& a, Session& session) {
  const auto opened = open_plan(a.plan, session);
  if (!opened) return wrong_input;
  const std::string& pieces = opened->job->stored().words().pieces;
  if (!std::filesystem::exists(opened->job->folder()))
    throw Error(Code::cannot_read, "there is no folder " + opened->job->folder() + "; no share has begun",
                {{"file", opened->job->folder()}});
  const stores::Gathered all = gathered(*opened, session);
  if (!all.repeated.empty())
    session.events.warn(format_count(all.repeated.size()) + " " + pieces +
                        " were made by several processes, the first " + std::to_string(all.repeated.front().id) +
                        "; they are equal, and are taken once");
  if (all.gaps.empty()) return opened->job->join(session);
  std::vector<std::string> gaps, shares;
  for (const PieceRange& gap : all.gaps) gaps.push_back(range_text(gap));
  for (int64_t n = 0; n < opened->count(); ++n)
    if (missing_in(opened->plan.shards[static_cast<size_t>(n)], all) > 0) shares.push_back(std::to_string(n + 1));
  constexpr size_t most = 10;
  const auto listed = [](std::vector<std::string> list) {
    const size_t others = list.size() > most ? list.size() - most : 0;
    list.resize(list.size() - others);
    return join(list, ", ") + (others > 0 ? " and " + format_count(others) + " more" : "");
  };
  throw Error(Code::unfinished,
              pieces + " " + listed(gaps) + " are missing, of shares " + listed(shares) +
                  "; run these again: ombre run " + a.plan + " --shard " + shares.front(),
              {{"file", opened->job->folder()}});
}

}  // namespace

JobKind plan_kind() {
  return job_kind<PlanChoices>("plan", "Share a job out among processes or machines", plan_footer, plan);
}

JobKind run_kind() {
  return job_kind<RunChoices>("run", "Make a share of a plan; with a .py file, run a Python script (see: ombre run -h)",
                              "", run);
}

JobKind status_kind() { return job_kind<StatusChoices>("status", "Say which shares of a plan are done", "", status); }

JobKind gather_kind() {
  return job_kind<StatusChoices>("gather", "Join what the shares of a plan have made", "", gather);
}

}  // namespace ombre::jobs

#include "jobs/shared_plan.h"

#include <algorithm>
#include <numeric>

#include "base/system/environment.h"
#include "base/text/json.h"
#include "base/text/record.h"
#include "base/text/text.h"
#include "jobs/common/session.h"
#include "jobs/common/shard_option.h"
#include "jobs/common/shard_ranges.h"

namespace ombre::jobs {
namespace {

using stores::PieceRange;

constexpr const char* plan_format = "ombre plan, version 1";

void read_job(SharedPlan& plan, const Data& data, const MemberReader& reader) {
  if (auto job = read_saved_job(data, reader)) plan.job = std::move(*job);
}

void read_description(SharedPlan& plan, const Data& data, const MemberReader& reader) {
  if (const DataMembers* members = reader.named(data, "what the plan describes")) plan.describes = *members;
}

void read_shards(SharedPlan& plan, const Data& data, const MemberReader& reader) {
  plan.shards = read_shard_ranges(data, reader);
}

void read_seconds(SharedPlan& plan, const Data& data, const MemberReader& reader) {
  const DataList* all = reader.list(data, "seconds");
  if (!all) return;
  for (const Data& seconds : *all)
    plan.seconds.push_back(reader.number(seconds, "the seconds of a share", {0}).value_or(0));
}

void check_plan(SharedPlan& plan, const Data& data, const MemberReader& reader) {
  if (plan.seconds.size() != plan.shards.size())
    reader.fail(data, "a plan has as many \"seconds\" as \"shards\"", "make the plan anew: ombre plan");
}

const Record<SharedPlan>& plan_record() {
  static const Record<SharedPlan> record =
      Record<SharedPlan>("a plan", {field::special("job", read_job).required("ombre plan writes it"),
                                    field::special("describes", read_description).required("ombre plan writes it"),
                                    field::special("shards", read_shards).required("ombre plan writes it"),
                                    field::special("seconds", read_seconds).required("ombre plan writes it"),
                                    field::number("memory_bytes", &SharedPlan::memory_bytes, {0}),
                                    field::flag("has_stages", &SharedPlan::has_stages)})
          .knows({"format", "program"})
          .checked(check_plan);
  return record;
}

// A variable in which a scheduler or MPI gives a process its number.
struct EngineVariable {
  const char* number;
  int64_t first;      // the number of the first process
  const char* count;  // the variable with the number of processes; null if there is one for each share
};

constexpr EngineVariable engines[] = {
    {"SLURM_ARRAY_TASK_ID", 1, nullptr},                  // sbatch --array=1-40
    {"JOB_COMPLETION_INDEX", 0, nullptr},                 // indexed jobs of Kubernetes
    {"AWS_BATCH_JOB_ARRAY_INDEX", 0, nullptr},            // array jobs of AWS Batch
    {"OMPI_COMM_WORLD_RANK", 0, "OMPI_COMM_WORLD_SIZE"},  // Open MPI
    {"PMI_RANK", 0, "PMI_SIZE"},                          // MPICH and others
};

std::optional<int64_t> environment_number(const char* name) {
  const auto number = parse_number(environment(name));
  return number ? std::optional(static_cast<int64_t>(*number)) : std::nullopt;
}

// Returns the first engine that gave this process a number; null if none did.
const EngineVariable* engine_here() {
  const auto* const found =
      std::ranges::find_if(engines, [](const auto& engine) { return environment_number(engine.number).has_value(); });
  return found == std::end(engines) ? nullptr : found;
}

std::vector<int64_t> shards_by_engine(int64_t count) {
  if (const EngineVariable* const engine = engine_here()) {
    const int64_t number = *environment_number(engine->number), place = number - engine->first;
    const int64_t step = engine->count ? environment_number(engine->count).value_or(count) : count;
    if (place < 0 || place >= step || step < 1)
      throw WrongArgument(std::string(engine->number) + " is " + std::to_string(number) + ", but the plan has shares " +
                          std::to_string(engine->first) + " to " + std::to_string(engine->first + count - 1) +
                          " in its count; start as many processes as the plan has shares");
    std::vector<int64_t> shards;
    for (int64_t shard = place + 1; shard <= count; shard += step) shards.push_back(shard);
    return shards;
  }
  throw WrongArgument("which share of the " + std::to_string(count) + "? write for example " +
                      spelled::option("--shard", "1") + " or " + spelled::option("--shard", "all") +
                      "; in a job array of Slurm, Kubernetes or AWS Batch, or under mpirun, it needs no " +
                      spelled::option("--shard"));
}

}  // namespace

std::vector<PieceRange> shards_of(const std::vector<double>& costs, int64_t first, int64_t count) {
  // All pieces cost the same if their costs are unknown.
  const double total = std::accumulate(costs.begin(), costs.end(), 0.0);
  const auto cost = [&](size_t piece) {
    return total > 0 ? costs[piece] / total : 1.0 / static_cast<double>(costs.size());
  };
  std::vector<PieceRange> shards;
  size_t next = 0;
  double so_far = 0;
  for (int64_t n = 1; n <= count; ++n) {
    const size_t begin = next;
    const double wanted = static_cast<double>(n) / static_cast<double>(count);
    // A piece belongs to the share in which its middle lies.
    while (next < costs.size() && (n == count || so_far + cost(next) / 2 < wanted)) so_far += cost(next++);
    shards.push_back({first + static_cast<int64_t>(begin), first + static_cast<int64_t>(next)});
  }
  return shards;
}

SharedPlan plan_of(SavedJob job, const SharedJob& shared, const PieceCosts& costs, int64_t count) {
  const int64_t first = shared.pieces().begin;
  SharedPlan plan{std::move(job),     shared.description(), shards_of(costs.seconds, first, count), {},
                  costs.memory_bytes, shared.has_stages()};
  for (const PieceRange& shard : plan.shards)
    plan.seconds.push_back(std::accumulate(costs.seconds.begin() + (shard.begin - first),
                                           costs.seconds.begin() + (shard.end - first), 0.0));
  return plan;
}

std::string plan_text(const SharedPlan& plan, const std::string& program) {
  DataList shards;
  for (const PieceRange& range : plan.shards) shards.emplace_back(DataList{number(range.begin), number(range.end)});
  return print_json(DataMembers{{"format", plan_format},
                                {"program", program},
                                {"job", saved_data(plan.job, program)},
                                {"describes", plan.describes},
                                {"shards", std::move(shards)},
                                {"seconds", DataList(plan.seconds.begin(), plan.seconds.end())},
                                {"memory_bytes", plan.memory_bytes},
                                {"has_stages", plan.has_stages}});
}

std::optional<SharedPlan> read_plan(const SourcePtr& source, Diagnostics& diagnostics) {
  const auto data = parse_json(source, diagnostics);
  if (!data) return std::nullopt;
  const MemberReader reader(diagnostics, Code::option);
  SharedPlan plan;
  if (const Data* said = data->find("format"); !said || *said != Data(plan_format))
    reader.fail(*data, "this is no plan",
                "a plan has \"format\": \"" + std::string(plan_format) + "\"; ombre plan writes one");
  else if (plan_record().read(*data, plan, reader) && !diagnostics.has_errors())
    return plan;
  return std::nullopt;
}

std::vector<int64_t> chosen_shards(const std::string& wanted, int64_t count) {
  if (wanted.empty()) return shards_by_engine(count);
  std::vector<int64_t> all(static_cast<size_t>(count));
  std::iota(all.begin(), all.end(), int64_t{1});
  if (wanted == "all") return all;
  const bool has_count = wanted.find('/') != std::string::npos;
  const stores::Shard shard =
      compile::parse_shard(has_count ? wanted : wanted + "/" + std::to_string(count), "--shard");
  if (shard.count != count)
    throw WrongArgument(spelled::option("--shard", wanted) + ": the plan has " + std::to_string(count) + " shares");
  return {shard.number};
}

int64_t mpi_processes() {
  const EngineVariable* const engine = engine_here();
  return engine && engine->count ? environment_number(engine->count).value_or(0) : 0;
}

}  // namespace ombre::jobs

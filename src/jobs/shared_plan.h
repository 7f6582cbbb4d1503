// Plans of jobs that processes share: files that say which pieces belong to which share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "jobs/common/shared_job.h"
#include "jobs/saved_job.h"
#include "stores/gather.h"

namespace ombre::jobs {

struct SharedPlan {
  SavedJob job;
  DataMembers describes;                   // everything that decides the pieces, as the job describes it
  std::vector<stores::PieceRange> shards;  // pieces of each share; some may have none
  std::vector<double> seconds;             // what each share is thought to take on one thread; 0 if unknown
  double memory_bytes = 0;                 // what a process is thought to take
  bool has_stages = false;                 // all shares need values of the whole job
};

// Returns ranges of about equal cost that follow one another, from piece `first` on.
std::vector<stores::PieceRange> shards_of(const std::vector<double>& costs, int64_t first, int64_t count);
// Plans shares of these costs. The job's description is its own.
SharedPlan plan_of(SavedJob job, const SharedJob& shared, const PieceCosts& costs, int64_t count);

// Returns the plan as JSON.
std::string plan_text(const SharedPlan& plan, const std::string& program);
// Returns nothing, and adds diagnostics, if the text is no plan.
std::optional<SharedPlan> read_plan(const SourcePtr& source, Diagnostics& diagnostics);

// Returns the numbers of the shares that this process is to do. `wanted` is "3", "3/40", "all", or empty: then the
// variables of a scheduler or of MPI say it. Throws WrongArgument.
std::vector<int64_t> chosen_shards(const std::string& wanted, int64_t count);
// Returns the number of processes of MPI that this one was started with; 0 if it was not, or is of a job array.
int64_t mpi_processes();

}  // namespace ombre::jobs

// The list of all kinds of jobs.
#pragma once

#include <string_view>
#include <vector>

#include "jobs/common/job_kind.h"

namespace ombre::jobs {

// Returns all kinds, in the order of the help.
const std::vector<JobKind>& all_jobs();
// Returns null if there is no such kind.
const JobKind* find_job(std::string_view name);

}  // namespace ombre::jobs

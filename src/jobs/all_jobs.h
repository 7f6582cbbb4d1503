// Every kind of job there is.
#pragma once

#include <string_view>
#include <vector>

#include "jobs/common/job_kind.h"

namespace ombre::jobs {

// In the order of the help.
const std::vector<JobKind>& all_jobs();
// Null where there is none.
const JobKind* find_job(std::string_view name);

}  // namespace ombre::jobs

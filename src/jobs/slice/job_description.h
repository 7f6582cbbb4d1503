// What job.json says: everything that decides a job's bytes, and its totals once it is complete.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"
#include "jobs/slice/job_journal.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// How the "format" member of every job.json begins.
inline constexpr std::string_view job_format = "ombre slice job";

// Without clock, host or thread count, so that equal jobs have equal files.
DataMembers describe_job(const SliceRequest& request);

// The sums over all layers, sorted by layer.
Data describe_totals(const SliceRequest& request, const std::vector<JournalEntry>& layers);

// "seed is 1 there and 2 here" for the first member, in order, that differs; empty when none does.
std::string first_difference(const DataMembers& there, const DataMembers& here);

}  // namespace ombre::compile

// Makes the contents of job.json: everything that decides a job's bytes, and its totals once it is complete.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "base/text/data.h"
#include "jobs/slice/layer_entry.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// The beginning of the "format" member of every job.json.
inline constexpr std::string_view job_format = "ombre slice job";

// Describes a job without clock, host or thread count, so that equal jobs have equal files.
DataMembers describe_job(const SliceRequest& request);

// Returns the sums over all layers.
Data describe_totals(const SliceRequest& request, const std::map<int64_t, LayerEntry>& layers);

// Returns a text such as "seed is 1 there and 2 here" for the first member that differs; empty if none does.
std::string first_difference(const DataMembers& there, const DataMembers& here);

}  // namespace ombre::compile

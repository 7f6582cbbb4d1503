// Reads job.json.
#pragma once

#include <optional>

#include "base/text/diagnostic.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// A job as its job.json describes it.
struct DescribedJob {
  SliceRequest request;
  bool is_complete = false;
  Data totals;  // as describe_totals() makes them; null until the job is complete
};

// Reads what describe_job() wrote. Returns nothing, and adds diagnostics with places, if the text describes no slice
// job or has members that are not understood.
std::optional<DescribedJob> read_job(const SourcePtr& source, Diagnostics& diagnostics);

}  // namespace ombre::compile

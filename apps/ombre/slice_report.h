// What `ombre slice` tells before, instead of and after its work.
#pragma once

#include <string>
#include <vector>

#include "jobs/slice/slice.h"
#include "ombre/console.h"

namespace ombre::cli {

void tell_plan(const Console& console, const compile::SliceRequest& request, const compile::SliceOptions& options);
void tell_estimate(const Console& console, const compile::SliceRequest& request,
                   const compile::SliceEstimate& estimate);
void tell_report(const Console& console, const compile::SliceRequest& request, const compile::SliceOptions& options,
                 const compile::SliceReport& report);
void tell_checks(const Console& console, const std::vector<compile::CheckReport>& checks);

// Warns where `what`, without which the job cannot do, takes more memory than is allowed.
void warn_of_memory(const Console& console, const std::string& what, double bytes, size_t allowed);

// Up to six decimals.
std::string mm_text(double mm);

}  // namespace ombre::cli

// Reports of `ombre slice` before, instead of and after its work.
#pragma once

#include <string>
#include <vector>

#include "jobs/common/events.h"
#include "jobs/slice/slice.h"

namespace ombre::jobs {

void tell_plan(const Events& events, const compile::SliceRequest& request, const compile::SliceOptions& options);
void tell_estimate(const Events& events, const compile::SliceRequest& request, const compile::SliceEstimate& estimate);
void tell_report(const Events& events, const compile::SliceRequest& request, const compile::SliceOptions& options,
                 const compile::SliceReport& report);
void tell_checks(const Events& events, const std::vector<compile::CheckReport>& checks);

}  // namespace ombre::jobs

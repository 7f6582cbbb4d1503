// Runs jobs, and reports those that fail.
#pragma once

#include <functional>

#include "jobs/common/events.h"

namespace ombre::jobs {

// Does the work, and returns its exit code. An exception becomes an error among the events, and the exit code that
// belongs to it; after Cancelled nothing is reported.
int run_reported(const Events& events, const std::function<int()>& work);

}  // namespace ombre::jobs

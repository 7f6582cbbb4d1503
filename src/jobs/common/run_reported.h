// What becomes of jobs that fail.
#pragma once

#include <functional>

#include "jobs/common/events.h"

namespace ombre::jobs {

// Does the work, and returns its exit code. What it throws becomes an error among the events, and the exit code that
// goes with it; after Cancelled nothing is said.
int run_reported(const Events& events, const std::function<int()>& work);

}  // namespace ombre::jobs

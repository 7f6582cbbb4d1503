// Remarks of several jobs.
#pragma once

#include <string>

#include "jobs/common/events.h"

namespace ombre::jobs {

// Warns if `what`, which the job needs, takes more memory than is allowed.
void warn_of_memory(const Events& events, const std::string& what, double bytes, size_t allowed);

// Formats a length with up to six decimals.
std::string mm_text(double mm);

}  // namespace ombre::jobs

// What several jobs say.
#pragma once

#include <string>

#include "jobs/common/events.h"

namespace ombre::jobs {

// Warns where `what`, without which the job cannot do, takes more memory than is allowed.
void warn_of_memory(const Events& events, const std::string& what, double bytes, size_t allowed);

// Up to six decimals.
std::string mm_text(double mm);

}  // namespace ombre::jobs

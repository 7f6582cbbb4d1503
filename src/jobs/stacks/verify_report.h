// Reports of `ombre verify`.
#pragma once

#include <string>

#include "jobs/common/events.h"
#include "jobs/stacks/verify.h"

namespace ombre::jobs {

void tell_verification(const Events& events, const compile::Verification& verification);
// Returns a page that needs no other files.
std::string verification_page(const std::string& stack, const compile::Verification& verification);

}  // namespace ombre::jobs

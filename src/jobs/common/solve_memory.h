// Refuses equations that take more memory than a job may have.
#pragma once

#include <cstddef>

#include "base/text/phrase.h"

namespace ombre::jobs {

// Throws Error if solving takes more than is allowed. `remedy` says how to reduce it: "choose larger bricks".
void refuse_little_memory(double bytes, size_t allowed, const Phrase& remedy);

}  // namespace ombre::jobs

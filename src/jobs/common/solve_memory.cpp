#include "jobs/common/solve_memory.h"

#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::jobs {

void refuse_little_memory(double bytes, size_t allowed, const Phrase& remedy) {
  if (bytes <= static_cast<double>(allowed)) return;
  throw Error(Code::memory, "solving takes about " + format_bytes(bytes) + " of memory, more than the " +
                                format_bytes(static_cast<double>(allowed)) + " allowed; " + remedy + ", or more " +
                                spelled::option("--memory"));
}

}  // namespace ombre::jobs

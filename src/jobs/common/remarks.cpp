#include "jobs/common/remarks.h"

#include "base/text/text.h"

namespace ombre::jobs {

void warn_of_memory(const Events& events, const std::string& what, double bytes, size_t allowed) {
  if (bytes <= static_cast<double>(allowed)) return;
  events.warn(what + " takes up to " + format_bytes(bytes) + ", more than the " + spelled::option("--memory") + " of " +
              format_bytes(static_cast<double>(allowed)) + "; coarser voxels or cells take less");
}

std::string mm_text(double mm) { return format_rounded(mm, 6); }

}  // namespace ombre::jobs

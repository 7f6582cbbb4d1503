// Warnings that state how often something was found in a file.
#include "formats/containers/counted_warnings.h"

#include <algorithm>

#include "base/text/text.h"

namespace ombre::formats {

void CountedWarnings::add(const std::string& one, const std::string& many, uint64_t times) {
  if (times == 0) return;
  const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.many == many; });
  if (known != entries_.end())
    known->count += times;
  else if (entries_.size() == most_kinds)
    others_ += times;
  else
    entries_.push_back({one, many, times});
}

void CountedWarnings::report(const std::string& file, Diagnostics& diagnostics) const {
  for (const Entry& entry : entries_)
    diagnostics.warning({},
                        file + ": " + (entry.count == 1 ? entry.one : format_count(entry.count) + ' ' + entry.many));
  if (others_ > 0) diagnostics.warning({}, file + ": " + format_count(others_) + " things of other kinds are not read");
}

}  // namespace ombre::formats

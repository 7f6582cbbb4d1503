// Numbers in the names of files that belong together.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ombre::sources {

// Compares names in natural order: slice_2 before slice_10.
bool is_numbered_before(const std::string& a, const std::string& b);
// Returns the first number missing between the last numbers in the sorted names; null if none is missing or a name has
// no number.
std::optional<int64_t> missing_number(const std::vector<std::string>& files);

}  // namespace ombre::sources

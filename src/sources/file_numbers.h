// Numbers in the names of files that belong together.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ombre::sources {

// Orders names as people count: slice_2 before slice_10.
bool is_numbered_before(const std::string& a, const std::string& b);
// The first number that is left out between the last numbers in the names of files in order; nothing where none is, or
// where some names have no number.
std::optional<int64_t> missing_number(const std::vector<std::string>& files);

}  // namespace ombre::sources

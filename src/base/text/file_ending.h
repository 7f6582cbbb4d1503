// The ending of a file's name, which says its format.
#pragma once

#include <filesystem>
#include <string>

namespace ombre {

// Returns the ending in small letters, with its dot: ".vtu"; an empty string where the name has none.
std::string ending_of(const std::filesystem::path& path);

}  // namespace ombre

// Endings of file names, which tell the format.
#pragma once

#include <filesystem>
#include <string>

namespace ombre {

// Returns the ending in lower case with its dot (".vtu"), or an empty string if there is none.
std::string ending_of(const std::filesystem::path& path);

}  // namespace ombre

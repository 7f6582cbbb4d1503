// The folders where files that are installed or built with this code lie.
#pragma once

#include <filesystem>
#include <vector>

namespace ombre {

// Returns the folder of the program or library that holds this code, then each folder above it except the root. Returns
// an empty list if the system does not tell.
std::vector<std::filesystem::path> own_folders();

}  // namespace ombre

// The folders of files that are installed, or built, together with this code.
#pragma once

#include <filesystem>
#include <vector>

namespace ombre {

// The folder of the program or of the library that holds this code, then each folder above that one but for the root.
// Empty where the system does not tell.
std::vector<std::filesystem::path> own_folders();

}  // namespace ombre

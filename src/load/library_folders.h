// Finds the libraries of operators that designs use.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ombre::compile {

// Returns the folders that `use` searches last: the user's, $XDG_DATA_HOME/ombre/library or
// ~/.local/share/ombre/library, and that of the program. A library is named by its path in one of them, such as
// ombre/cellular.vcad.
std::vector<std::string> library_folders();
// Returns the folder of the program's own libraries; none if they are not installed.
std::vector<std::string> own_library_folders();

// Returns the path in its library folder of a file that lies in one of them, else nothing. The path must be canonical.
std::optional<std::string> name_in_library(const std::filesystem::path& file);

}  // namespace ombre::compile

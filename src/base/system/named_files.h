// Paths of files that are named in other files, and names of files in folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ombre {

// Returns the paths to try for `path`, in order: beside the file that names it, beside each file that this one links
// to, and in the working directory. An absolute path is returned alone.
std::vector<std::string> places_of(const std::string& path, const std::string& named_by);

// Returns a file's absolute path, in which links of folders are resolved. A file that is a link itself stays one.
std::filesystem::path whole_path(const std::filesystem::path& file);

// Returns the names of what lies in a folder, in order. Throws Error, and std::bad_alloc, where the iterators of
// libstdc++ end the program.
std::vector<std::string> names_in(const std::string& folder);

}  // namespace ombre

// Files of VTK that name grids in other files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

// Collections of steps and parts (.pvd), and grids in pieces (.pvtu), by the beginning of the file.
bool is_pvd(std::string_view bytes);
bool is_pvtu(std::string_view bytes);

// Returns the names of the files, as they are written there.
std::vector<std::string> files_named_in_pvd(std::string_view bytes, uint64_t step);
std::vector<std::string> files_named_in_pvtu(std::string_view bytes, uint64_t step);

// Returns the name of a file that `written`, itself named by another file, names beside itself, as that other file
// would write it. Returns the name itself if `written` is empty.
std::string name_beside(const std::string& written, const std::string& name);

}  // namespace ombre::formats

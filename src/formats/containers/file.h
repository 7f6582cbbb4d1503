// Whole files in memory.
#pragma once

#include <string>

namespace ombre::formats {

// The bytes of a file. Throws Error, naming the path and the reason, for what cannot be read
// (missing, a directory, not permitted).
std::string read_file(const std::string& path);

}  // namespace ombre::formats

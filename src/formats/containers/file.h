// Reads whole files into memory.
#pragma once

#include <string>

namespace ombre::formats {

// Returns the bytes of a file. Throws Error, naming the path and the reason, if it cannot be read (missing, a
// directory, no permission).
std::string read_file(const std::string& path);

}  // namespace ombre::formats

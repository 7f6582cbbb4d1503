// Checks the places of files that are to be written.
#pragma once

#include <string>
#include <vector>

namespace ombre::jobs {

// Throws Error if something exists at `path`, unless it is a file and `force` is set. Also throws if its folder is
// missing or may not be written.
void refuse_to_overwrite(const std::string& path, bool force);

// Throws WrongArgument if -o names no design file.
void check_design_file(const std::string& path);

// Throws Error if one of the files exists that shares of a job are joined in.
void refuse_joined(const std::vector<std::string>& paths);

}  // namespace ombre::jobs

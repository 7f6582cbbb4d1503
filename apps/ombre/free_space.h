// Words about disks that are too small for what is still to be written.
#pragma once

#include <optional>
#include <string>

namespace ombre::cli {

// What the disk of `folder`, which may not exist yet, has left; nothing where the system does not tell.
std::optional<double> free_bytes(const std::string& folder);

// Empty where the disk of `folder`, which may not exist yet, has room for so many bytes or does not tell.
std::string space_warning(const std::string& folder, double bytes);

}  // namespace ombre::cli

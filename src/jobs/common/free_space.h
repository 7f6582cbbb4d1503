// Disks that are too small for what is to be written.
#pragma once

#include <optional>
#include <string>

#include "base/text/phrase.h"

namespace ombre::jobs {

// What the disk of `folder`, which may not exist yet, has left; nothing where the system does not tell.
std::optional<double> free_bytes(const std::string& folder);

// Throws Error where the disk of the file `path` has less room; `what` takes it: "the grid". `remedy` says what makes
// it smaller: "choose larger voxels".
void refuse_small_disk(const std::string& path, double bytes, const std::string& what, const Phrase& remedy);

// Empty where the disk of `folder`, which may not exist yet, has room for so many bytes or does not tell.
std::string space_warning(const std::string& folder, double bytes);

}  // namespace ombre::jobs

// Checks the free space of disks.
#pragma once

#include <optional>
#include <string>

#include "base/text/phrase.h"

namespace ombre::jobs {

// Returns the free bytes on the disk of `folder`, which may not exist yet; nothing if the system does not tell.
std::optional<double> free_bytes(const std::string& folder);

// Throws Error if the disk of the file `path` has less room. `what` names the content, "the grid", and `remedy` says
// how to make it smaller, "choose larger voxels".
void refuse_small_disk(const std::string& path, double bytes, const std::string& what, const Phrase& remedy);

// Returns a warning if the disk of `folder`, which may not exist yet, has less room; else an empty text.
std::string space_warning(const std::string& folder, double bytes);

}  // namespace ombre::jobs

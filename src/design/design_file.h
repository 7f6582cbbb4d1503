// The text of a design file, which names other files relative to its own folder.
#pragma once

#include <string>

#include "base/text/data.h"
#include "design/registry.h"

namespace ombre::design {

// Returns the text of the design file `path` for what `to_data` returned. The names of files that the design reads are
// then relative to the folder of `path`, as readers expect; in `data` they are relative to the working directory.
// Absolute names stay.
std::string design_text(const Data& data, const Registry& registry, const std::string& path);

}  // namespace ombre::design

// Makes polyhedra of the parts of a design.
#pragma once

#include <optional>

#include "base/system/progress.h"
#include "base/text/diagnostic.h"
#include "load/loaded.h"
#include "solids/solid.h"

namespace ombre::compile {

// Returns the surfaces of a design's parts as pieces, each with the part's name and the mean colour of its materials.
// Returns nothing, and adds diagnostics, if they cannot be made. Throws Cancelled.
std::optional<solids::Pieces> meshed_parts(const LoadedPtr& loaded, Diagnostics& diagnostics, const StopFlag* stop);

}  // namespace ombre::compile

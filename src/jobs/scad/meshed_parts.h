// The parts of a design as polyhedra.
#pragma once

#include <optional>

#include "base/system/progress.h"
#include "base/text/diagnostic.h"
#include "load/loaded.h"
#include "solids/solid.h"

namespace ombre::compile {

// The surfaces of a design's parts as pieces, each with the part's name and the colour that its materials mix to.
// Nothing, and diagnostics, where they cannot be made. Throws Cancelled.
std::optional<solids::Pieces> meshed_parts(const LoadedPtr& loaded, Diagnostics& diagnostics, const StopFlag* stop);

}  // namespace ombre::compile

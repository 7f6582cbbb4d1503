// Makes closed surfaces of a design: of the whole, or of its regions.
#pragma once

#include <optional>

#include "base/system/progress.h"
#include "jobs/mesh/meshed_design.h"
#include "load/loaded.h"

namespace ombre::compile {

// Makes the surfaces. Returns nothing, and adds diagnostics, when the design is empty, or cannot be cut so. Throws
// Cancelled.
std::optional<MeshedDesign> mesh_design(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                        Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::compile

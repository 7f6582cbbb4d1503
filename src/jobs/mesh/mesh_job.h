// Makes closed surfaces of a design: of the whole, or of its regions.
#pragma once

#include <optional>

#include "base/system/progress.h"
#include "jobs/mesh/planned_mesh.h"
#include "surface/cells/grid_borders.h"

namespace ombre::compile {

// Plans a mesh without beams. Returns nothing, and adds diagnostics, when the design is empty, or cannot be cut so.
// Throws Cancelled.
std::optional<PlannedMesh> plan_mesh(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                     Progress* progress = nullptr, const StopFlag* stop = nullptr);
// Makes its surface. What is known of the borders in its grid is not found again; null: nothing is. Throws Cancelled.
MeshedDesign make_mesh(const PlannedMesh& planned, const surface::GridBorders* known, Diagnostics& diagnostics,
                       Progress* progress = nullptr);

// Makes the surfaces. Returns nothing, and adds diagnostics, when the design is empty, or cannot be cut so. Throws
// Cancelled.
std::optional<MeshedDesign> mesh_design(const Loaded& loaded, const MeshRequest& request, Diagnostics& diagnostics,
                                        Progress* progress = nullptr, const StopFlag* stop = nullptr);

}  // namespace ombre::compile

// Bodies of designs that consist of polyhedra, without a grid.
#pragma once

#include <optional>

#include "base/system/progress.h"
#include "jobs/mesh/meshed_design.h"

namespace ombre::compile {

// Returns the surfaces of a design whose solids are polyhedra as an OpenSCAD script makes them, in named parts and
// unions but otherwise unchanged. They have the triangles of the polyhedra, cut where solids of different regions
// overlap. Returns nothing for other designs, for requests of bands, and where solids of different materials would mix.
// Throws Cancelled.
std::optional<MeshedDesign> exact_bodies(const design::Design& design, const MeshRequest& request,
                                         const StopFlag* stop);

}  // namespace ombre::compile

// Converts pieces of polyhedral geometry to a leaf of the design graph.
#pragma once

#include <string>

#include "design/source_loader.h"
#include "solids/solid.h"
#include "sources/loading.h"

namespace ombre::sources {

// Returns a request for the solids among the pieces; `name` is used in messages.
design::SolidsRequest solids_request(const solids::Pieces& pieces, std::string name, design::MeshUse use = {});

// Returns the solids of a script with their names and materials. `pieces` are all solids; the use applies to them.
// Null, with diagnostics, if they have no materials of that kind.
std::shared_ptr<const design::ScadSolids> scad_solids(const solids::Pieces& pieces, const std::string& name,
                                                      const design::MeshUse& use, Loading& loading);

}  // namespace ombre::sources

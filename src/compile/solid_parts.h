// Pieces of polyhedral geometry as a leaf of the design graph.
#pragma once

#include <string>

#include "design/source_loader.h"
#include "solids/solid.h"

namespace ombre::compile {

// The solids among the pieces, for a design::SolidsRequest: what it gives has exact rows and distances, and its
// materials are looked up by name among the design's (an error lists them where one is unknown). `name` is for
// messages. Where no piece names a material, all are of the use's own.
design::SolidsRequest solids_request(const solids::Pieces& pieces, std::string name, design::MeshUse use = {});

}  // namespace ombre::compile

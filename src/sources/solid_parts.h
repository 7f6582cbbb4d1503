// Pieces of polyhedral geometry as a leaf of the design graph.
#pragma once

#include <string>

#include "design/source_loader.h"
#include "solids/solid.h"

namespace ombre::sources {

// The solids among the pieces. `name` is for messages.
design::SolidsRequest solids_request(const solids::Pieces& pieces, std::string name, design::MeshUse use = {});

}  // namespace ombre::sources

// Converts pieces of polyhedral geometry to a leaf of the design graph.
#pragma once

#include <string>

#include "design/source_loader.h"
#include "solids/solid.h"

namespace ombre::sources {

// Returns a request for the solids among the pieces; `name` is used in messages.
design::SolidsRequest solids_request(const solids::Pieces& pieces, std::string name, design::MeshUse use = {});

}  // namespace ombre::sources

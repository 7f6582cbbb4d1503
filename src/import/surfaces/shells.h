// The closed shells of a mesh and their orientation.
#pragma once

#include <cstdint>
#include <vector>

#include "import/surfaces/mesh_edges.h"

namespace ombre::importing {

// Returns the number of each triangle's shell, counted from 0 in the order of the triangles. Where more
// than two triangles meet at an edge, shells that are open there by themselves are joined.
std::vector<uint32_t> shells_of(size_t triangles, std::span<const FacetEdge> edges);

struct TurnedShells {
  size_t turned = 0, shells = 0;
};

// Turns shells of a closed mesh around that face inward, lie in no other shell, and overlap the box of an
// outward-facing shell that does not lie in them: otherwise both would cancel out where they overlap. Shells inside of
// a turned shell are turned too.
TurnedShells turn_inverted_shells(formats::Mesh& mesh);

}  // namespace ombre::importing

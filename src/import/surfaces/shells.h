// The closed shells of a mesh, and which way they face.
#pragma once

#include <cstdint>
#include <vector>

#include "import/surfaces/mesh_edges.h"

namespace ombre::importing {

// The number of the shell that each triangle belongs to, counted from 0 in the order of the triangles. Where more than
// two triangles meet in an edge, only those belong together that are not closed there without each other.
std::vector<uint32_t> shells_of(size_t triangles, std::span<const FacetEdge> edges);

struct TurnedShells {
  size_t turned = 0, shells = 0;
};

// Turns shells of a closed mesh round that face inward, lie in no other, and overlap the box of one that faces outward
// and does not lie in them: where the two overlap, they would cancel out. What lies in them is turned with them.
TurnedShells turn_inverted_shells(formats::Mesh& mesh);

}  // namespace ombre::importing

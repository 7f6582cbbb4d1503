// Finds where a surface is not closed.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "formats/mesh/mesh.h"

namespace ombre::importing {

struct OpenEdges {
  size_t count = 0;             // edges that triangles traverse in one direction more often than in the other
  std::array<Vec3, 2> example;  // one of them
  // Approximate width of the widest gap in mm; infinite if no edge lies opposite.
  double gap_mm = std::numeric_limits<double>::infinity();
};

// Returns the open edges, or null for a closed mesh. Vertices at exactly the same place count as one.
std::optional<OpenEdges> find_open_edges(const formats::Mesh& mesh);

}  // namespace ombre::importing

// Where a surface does not close.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "formats/mesh/mesh.h"

namespace ombre::importing {

struct OpenEdges {
  size_t count = 0;             // edges that triangles pass in one direction more often than in the other
  std::array<Vec3, 2> example;  // one of them
  // About how far apart the borders of its widest gap are, mm; infinite where nothing lies opposite.
  double gap_mm = std::numeric_limits<double>::infinity();
};

// Nothing for a closed mesh. Vertices at exactly the same place count as one.
std::optional<OpenEdges> find_open_edges(const formats::Mesh& mesh);

}  // namespace ombre::importing

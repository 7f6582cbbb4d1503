// Defects and size of a mesh.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/math/box.h"
#include "formats/mesh/mesh.h"

namespace ombre::importing {

struct MeshReport {
  size_t triangles = 0;
  size_t degenerate = 0;  // triangles without area, which do no harm
  size_t open_edges = 0;  // edges of an odd number of triangles
  // edges along which triangles run in the same direction, because one of them is inside out
  size_t inconsistent_edges = 0;
  std::vector<std::array<Vec3, 2>> examples;  // a few open or inconsistent edges
  size_t shells = 0, inward_shells = 0;       // for a closed mesh: number of shells, and of those that face inward
  double volume = 0;                          // mm3; negative if the triangles face inward
  double area = 0;                            // mm2
  Box bounds;

  // Returns true if every directed edge occurs as often as its reverse, so that winding numbers are well defined.
  bool is_closed() const { return open_edges == 0 && inconsistent_edges == 0; }
};

// Inspects a mesh of any triangles, or none. Vertices at exactly the same place count as one.
MeshReport inspect(const formats::Mesh& mesh);

}  // namespace ombre::importing

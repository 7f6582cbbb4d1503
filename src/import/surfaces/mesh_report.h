// What is wrong with a mesh, and how large it is.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/math/box.h"
#include "formats/mesh/mesh.h"

namespace ombre::importing {

struct MeshReport {
  size_t triangles = 0;
  size_t degenerate = 0;                      // without area; they do no harm
  size_t open_edges = 0;                      // an odd number of triangles meets there
  size_t inconsistent_edges = 0;              // triangles run along it in the same direction: one of them is inside out
  std::vector<std::array<Vec3, 2>> examples;  // a few of these edges
  size_t shells = 0, inward_shells = 0;       // of a closed mesh; of these, those that face inward
  double volume = 0;                          // mm3; negative if the triangles face inward
  double area = 0;                            // mm2
  Box bounds;

  // Every directed edge is there as often as its reverse, so winding numbers are well defined.
  bool is_closed() const { return open_edges == 0 && inconsistent_edges == 0; }
};

// Vertices at exactly the same place count as one. Any triangles will do, also none.
MeshReport inspect(const formats::Mesh& mesh);

}  // namespace ombre::importing

// Joins corners of triangles that differ by rounding.
#pragma once

#include <optional>

#include "formats/mesh/mesh.h"

namespace ombre::importing {

struct WeldedCorners {
  size_t corners = 0;      // number of corners joined with others
  double farthest_mm = 0;  // greatest distance between joined corners
};

// Closes a surface that is open because its corners differ by rounding: corners at open edges nearer to each other than
// a tolerance become one. The tolerance is the smallest that closes all open edges, at most 1e-5 of the mesh's size,
// and no edge may collapse that is longer than rounding to floats explains. If that fails, returns null and changes
// nothing. With `any_direction`, edges whose triangles face different ways count as closed too.
std::optional<WeldedCorners> weld_corners(formats::Mesh& mesh, bool any_direction);

}  // namespace ombre::importing

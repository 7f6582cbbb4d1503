// Joins corners of triangles that differ by rounding.
#pragma once

#include <optional>

#include "formats/mesh/mesh.h"

namespace ombre::importing {

struct WeldedCorners {
  size_t corners = 0;      // that were joined with others
  double farthest_mm = 0;  // between two of them
};

// Closes a surface that is open because its corners differ by rounding: corners at open edges that are nearer to each
// other than a tolerance become one. The tolerance is the smallest that closes all open edges, and at most 1e-5 of the
// mesh's size; no edge collapses that is longer than rounding to floats explains. Otherwise nothing changes. With
// `any_direction`, edges count as closed also where their triangles face different ways.
std::optional<WeldedCorners> weld_corners(formats::Mesh& mesh, bool any_direction);

}  // namespace ombre::importing

// Finds the sharp edges of surfaces, as lines that meet in corners.
#pragma once

#include <vector>

#include "surface/mesh/bodies.h"

namespace ombre::compile {

struct SharpEdges {
  std::vector<std::vector<Vec3>> lines;  // mm; closed lines begin and end in the same point
  std::vector<Vec3> smooth_points;       // some points of each closed surface that has no sharp edge
  std::vector<Vec3> face_points;         // some points of each face between sharp edges, far from them
};

// Finds the edges of the bodies whose triangles' normals differ by more than some forty degrees; edges that bodies
// share are listed once. Lines go from one corner to the next, where others meet or they turn sharply, and leave out
// points within the tolerance. Lines shorter than half the size of elements with an open end are left out. So are those
// of rough places: connected lines with an open end that are shorter together than four sizes. The ends of lines far
// shorter than elements become one corner.
SharpEdges find_sharp_edges(const std::vector<surface::Body>& bodies, double tolerance_mm, double size_mm);

}  // namespace ombre::compile

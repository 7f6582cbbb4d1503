// The sharp edges of surfaces, as lines that meet in corners.
#pragma once

#include <vector>

#include "surface/mesh/bodies.h"

namespace ombre::compile {

struct SharpEdges {
  std::vector<std::vector<Vec3>> lines;  // mm; closed ones begin and end in the same point
  std::vector<Vec3> smooth_points;       // some of each closed surface that has no sharp edge
  std::vector<Vec3> face_points;         // some of each face between sharp edges, far from them
};

// Edges of the bodies whose triangles' normals differ by more than some forty degrees; lines go from one corner to the
// next, where others meet or they turn sharply, and leave out points within the tolerance. What bodies share is there
// once. Lines that are shorter than half the size of elements and end nowhere are
// left out, and so are those of rough places: lines that hang together, some of which end nowhere, shorter together
// than four sizes. The ends of lines far shorter than elements become one corner.
SharpEdges find_sharp_edges(const std::vector<surface::Body>& bodies, double tolerance_mm, double size_mm);

}  // namespace ombre::compile

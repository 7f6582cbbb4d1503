// Solids and regions that a tree's leaves describe by numbers, with the vertices that OpenSCAD gives them. What has no
// volume (a side or radius of 0 or less) is empty.
#pragma once

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

TriangleMesh mesh_of(const Cube& cube);
// Rings at half steps from the poles: no vertex is a pole.
TriangleMesh mesh_of(const Sphere& sphere);
TriangleMesh mesh_of(const Cylinder& cylinder);
// Faces are cut into triangles; what is wrong with them is reported at `where`.
TriangleMesh mesh_of(const Polyhedron& polyhedron, const SourceRange& where, Diagnostics& messages);

std::vector<Ring> rings_of(const Square& square);
std::vector<Ring> rings_of(const Circle& circle);
// As they are given: they may cross, and inside is where an odd number goes round.
std::vector<Ring> rings_of(const Polygon& polygon, const SourceRange& where, Diagnostics& messages);

}  // namespace ombre::solids

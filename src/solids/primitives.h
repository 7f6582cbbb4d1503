// Solids and regions of leaves given by numbers, with the same vertices as in OpenSCAD. Shapes without volume (a side
// or radius of 0 or less) are empty.
#pragma once

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

TriangleMesh mesh_of(const Cube& cube);
// Returns a sphere with rings at half steps from the poles, so no vertex is a pole.
TriangleMesh mesh_of(const Sphere& sphere);
TriangleMesh mesh_of(const Cylinder& cylinder);
// Returns a polyhedron with its faces split into triangles; errors in them are reported at `where`.
TriangleMesh mesh_of(const Polyhedron& polyhedron, const SourceRange& where, Diagnostics& messages);

std::vector<Ring> rings_of(const Square& square);
std::vector<Ring> rings_of(const Circle& circle);
// Returns the rings as given. They may cross; a point is inside if an odd number of rings encloses it.
std::vector<Ring> rings_of(const Polygon& polygon, const SourceRange& where, Diagnostics& messages);

}  // namespace ombre::solids

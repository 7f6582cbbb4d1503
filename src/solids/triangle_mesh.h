// Polyhedra by their triangles, and in the form of a geometry kernel. Millimetres.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/math/box.h"
#include "base/math/vec.h"

namespace ombre::solids {

using Triangle = std::array<uint32_t, 3>;

// Triangles are counter-clockwise when seen from outside.
struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

Box bounds_of(const TriangleMesh& mesh);
// Of a closed mesh, mm3; negative where it is inside out.
double volume_of(const TriangleMesh& mesh);
// The image under a map with a determinant other than 0; mirrored triangles are turned round.
TriangleMesh moved(const TriangleMesh& mesh, const Affine& map);

// Equal points become one, points that no triangle uses go, and so do triangles with fewer than three corners.
TriangleMesh tidied(const TriangleMesh& mesh);

// The same surface with its points and triangles in an order that their coordinates decide.
TriangleMesh sorted(const TriangleMesh& mesh);

class Body;  // of a geometry kernel, with exact coordinates
using BodyPtr = std::shared_ptr<const Body>;

}  // namespace ombre::solids

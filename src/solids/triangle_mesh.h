// Polyhedra as triangles. Lengths are in millimetres.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/math/box.h"
#include "base/math/vec.h"

namespace ombre::solids {

using Triangle = std::array<uint32_t, 3>;

// A mesh whose triangles are counter-clockwise when seen from outside.
struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

Box bounds_of(const TriangleMesh& mesh);
// Returns the volume of a closed mesh in mm3, negative if it is inside out.
double volume_of(const TriangleMesh& mesh);
// Returns false if a coordinate is infinite or no number.
bool is_finite(const TriangleMesh& mesh);
// Returns the image under a map with a determinant other than 0; triangles are reversed if the map mirrors.
TriangleMesh moved(const TriangleMesh& mesh, const Affine& map);

// Merges equal points, and removes unused points and triangles with fewer than three different corners.
TriangleMesh tidied(const TriangleMesh& mesh);

// Returns the same surface with points and triangles in an order that depends only on their coordinates.
TriangleMesh sorted(const TriangleMesh& mesh);

class Body;  // a body of a geometry kernel, with exact coordinates
using BodyPtr = std::shared_ptr<const Body>;

}  // namespace ombre::solids

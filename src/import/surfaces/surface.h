// The triangles of a mesh, as the queries of this folder use them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/math/box.h"
#include "base/math/vec.h"

namespace ombre::importing {

struct Surface {
  std::vector<Vec3> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;

  std::array<Vec3, 3> corners(uint32_t triangle) const {
    const auto& t = triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
};

using SurfacePtr = std::shared_ptr<const Surface>;

// Returns the bounds of the vertices that triangles use.
inline Box bounds(const Surface& surface) {
  Box box;
  for (const auto& triangle : surface.triangles)
    for (const uint32_t i : triangle) box = hull(box, Box{surface.vertices[i], surface.vertices[i]});
  return box;
}

}  // namespace ombre::importing

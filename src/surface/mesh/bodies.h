// One region's closed surface, as programs that read meshes want it.
#pragma once

#include <array>
#include <vector>

#include "surface/mesh/contour_types.h"

namespace ombre::surface {

struct Body {
  std::vector<Vec3> vertices;                      // mm
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside
};

// The facets around a region. Where its surface touches itself in an edge or a vertex, that is there once for each
// sheet, so that every edge has two triangles and every vertex one fan: a closed manifold. Vertices keep the order and
// the bits that they have in the surface, so neighbours meet exactly.
Body body_of(const RegionSurface& surface, Label region);

double volume_mm3(const Body& body);
double area_mm2(const Body& body);

}  // namespace ombre::surface

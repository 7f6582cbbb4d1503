// The closed surface of one region, in the form that programs which read meshes expect.
#pragma once

#include <array>
#include <vector>

#include "surface/mesh/contour_types.h"

namespace ombre::surface {

struct Body {
  std::vector<Vec3> vertices;                      // mm
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise from outside
};

// Returns the facets around a region. If the region's surface touches itself in an edge or a vertex, that edge or
// vertex is duplicated for each sheet. The result is a closed manifold: every edge has two triangles and every vertex
// one fan. Vertices keep the order and the exact coordinates of the surface, so neighbouring bodies meet exactly.
Body body_of(const RegionSurface& surface, Label region);

double volume_mm3(const Body& body);
double area_mm2(const Body& body);

}  // namespace ombre::surface

// How far points are from the facets of a surface.
#pragma once

#include <vector>

#include "surface/quad_surface.h"

namespace ombre::surface {

// From each point to the nearest facet within reach; infinite where there is none.
std::vector<double> distances_to_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                        int threads);
// Whether a facet is within reach of each point.
std::vector<bool> are_near_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                  int threads);

}  // namespace ombre::surface

// How far points are from the facets of a surface.
#pragma once

#include <vector>

#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

// From each point to the nearest facet within reach; infinite where there is none.
std::vector<double> distances_to_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                        const Workers& workers);
struct Ball {
  Vec3 center;
  double radius_mm = 0;
};

// Whether each ball meets a facet.
std::vector<bool> meet_facets(const std::vector<Ball>& balls, const QuadSurface& surface, const Workers& workers);
// One of these quads.
std::vector<bool> meet_facets(const std::vector<Ball>& balls, const QuadSurface& surface,
                              const std::vector<uint32_t>& quads, const Workers& workers);

}  // namespace ombre::surface

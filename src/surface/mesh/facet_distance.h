// Distances from points to the facets of a surface.
#pragma once

#include <vector>

#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

// Returns for each point the distance to the nearest facet, or infinity if there is none within reach.
std::vector<double> distances_to_facets(const std::vector<Vec3>& points, const QuadSurface& surface, double reach_mm,
                                        const Workers& workers);
struct Ball {
  Vec3 center;
  double radius_mm = 0;
};

// Returns for each ball whether a facet meets it.
std::vector<bool> meet_facets(const std::vector<Ball>& balls, const QuadSurface& surface, const Workers& workers);
// Returns for each ball whether a facet of the given quads meets it.
std::vector<bool> meet_facets(const std::vector<Ball>& balls, const QuadSurface& surface,
                              const std::vector<uint32_t>& quads, const Workers& workers);

}  // namespace ombre::surface

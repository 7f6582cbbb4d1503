// Checks whether the facets and the borders of regions agree within a tolerance.
#pragma once

#include <functional>
#include <vector>

#include "surface/cells/hidden_edges.h"
#include "surface/mesh/facet_distance.h"
#include "surface/mesh/quad_surface.h"
#include "surface/mesh/seen_quads.h"
#include "surface/mesh/surface_distance.h"

namespace ombre::surface {

// Hands out the hidden edges of a grid.
using EachHiddenEdge = std::function<void(const TakeEdges& take)>;

class FacetCheck {
 public:
  FacetCheck(const Partition& partition, const ContourOptions& options);

  // Checks samples of the facets, borders beside the samples, and crossings, except those that were near before and
  // whose quads are unchanged. Throws Cancelled.
  void check(const QuadSurface& surface);
  // Updates the numbers of quads after the crossings, and so the quads around them, were renumbered.
  void renumber(const std::vector<Crossing>& crossings);
  // Returns the quads that were too far off in the last check, in order.
  std::vector<uint32_t> far_quads() const;
  // Returns points of borders that the far quads miss.
  std::vector<Vec3> missed_borders() const;
  // Returns those of the hidden edges whose border has no facet within reach. If there are more than `most`, returns
  // none, and counts them as far in farthest_in_tolerances(). No leaf of the tree may be subdivided yet. Throws
  // Cancelled.
  std::vector<CrossedEdge> far_hidden_edges(const QuadSurface& surface, const CellTree& tree,
                                            const EachHiddenEdge& each, size_t most);
  // Returns the greatest distance in tolerances at the far samples (at most a thousand of them), at crossings and at
  // hidden borders counted as far; 1 if all are near. Throws Cancelled.
  double farthest_in_tolerances(const QuadSurface& surface) const;

 private:
  struct Far {
    uint32_t quad = 0;
    SurfaceSample sample;
  };
  // A border that the quad's triangles miss.
  struct FarBorder {
    uint32_t quad = 0;
    Vec3 at;
  };

  // Appends to `far` the hidden edges whose border has no facet within reach, and to `places` the points on these
  // borders.
  void add_far_among(const std::vector<CrossedEdge>& hidden, const QuadSurface& surface, const CellTree& tree,
                     std::vector<CrossedEdge>& far, std::vector<Vec3>& places) const;
  void check_facets(const QuadSurface& surface, const std::vector<uint32_t>& quads);
  // Returns a ball around each border. A facet that meets the ball is near the border.
  std::vector<Ball> balls_around(const std::vector<FarBorder>& borders, const QuadSurface& surface) const;
  void keep_far_borders(const QuadSurface& surface, const std::vector<uint32_t>& changed);
  // Adds the found borders that have no facet near them.
  void add_far_borders(const QuadSurface& surface, std::vector<FarBorder> found);
  void check_crossings(const QuadSurface& surface, const std::vector<uint32_t>& changed);

  const Partition& partition_;
  double tolerance_mm_, reach_mm_, border_reach_mm_, spacing_mm_;
  int fine_level_;  // greatest level of cells no wider than the tolerance; -1 if there is none
  Workers workers_;
  SeenQuads seen_;
  std::vector<Far> far_;                // sorted by quad
  std::vector<FarBorder> far_borders_;  // sorted by quad
  std::vector<uint32_t> far_crossings_;
  std::vector<Vec3> left_hidden_;  // sample of the hidden borders, if there were too many
};

}  // namespace ombre::surface

// Whether facets and the borders of regions keep together within a tolerance.
#pragma once

#include <vector>

#include "surface/quad_surface.h"
#include "surface/seen_quads.h"
#include "surface/surface_distance.h"

namespace ombre::surface {

class FacetCheck {
 public:
  FacetCheck(const Partition& partition, const ContourOptions& options, const StopFlag* stop);

  // Looks at samples of facets, at borders beside them and at crossings, but for those that were near already. Throws
  // Cancelled.
  void check(const QuadSurface& surface);
  // Crossings, and the quads around them, have other numbers.
  void renumber(const std::vector<Crossing>& crossings);
  // As the last look said; in order.
  std::vector<uint32_t> far_quads() const;
  // Borders that no corner of the grid's cells sees and no facet is near; none if they are more than `most`. Nothing of
  // the tree is cut. Throws Cancelled.
  std::vector<CrossedEdge> far_hidden_edges(const QuadSurface& surface, const CellTree& tree, size_t most) const;
  // At the samples, or a thousand of the far ones, and at crossings; 1 when all are near. Throws Cancelled.
  double farthest_in_tolerances(const QuadSurface& surface) const;

 private:
  struct Far {
    uint32_t quad = 0;
    SurfaceSample sample;
  };
  // A border that the quad's triangles pass by.
  struct FarBorder {
    uint32_t quad = 0;
    Vec3 at;
  };

  std::vector<CrossedEdge> far_among(const std::vector<CrossedEdge>& hidden, const QuadSurface& surface,
                                     const CellTree& tree) const;
  void check_facets(const QuadSurface& surface, const std::vector<uint32_t>& quads);
  static std::vector<Vec3> places_of(const std::vector<FarBorder>& borders);
  void keep_far_borders(const QuadSurface& surface, const std::vector<uint32_t>& changed);
  // Of those that were found, the ones that no facet is near.
  void add_far_borders(const QuadSurface& surface, std::vector<FarBorder> found);
  void check_crossings(const QuadSurface& surface, const std::vector<uint32_t>& changed);

  const Partition& partition_;
  double tolerance_mm_, reach_mm_, border_reach_mm_, spacing_mm_;
  int threads_;
  const StopFlag* stop_;
  SeenQuads seen_;
  std::vector<Far> far_;                // in order of quads
  std::vector<FarBorder> far_borders_;  // in order of quads
  std::vector<uint32_t> far_crossings_;
};

}  // namespace ombre::surface

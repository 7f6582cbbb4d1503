// Checks whether facets and the borders of regions agree within a tolerance.
#pragma once

#include <vector>

#include "surface/mesh/facet_distance.h"
#include "surface/mesh/quad_surface.h"
#include "surface/mesh/seen_quads.h"
#include "surface/mesh/surface_distance.h"

namespace ombre::surface {

class FacetCheck {
 public:
  FacetCheck(const Partition& partition, const ContourOptions& options);

  // Checks samples of facets, at borders beside them and at crossings, but for those that were near already. Throws
  // Cancelled.
  void check(const QuadSurface& surface);
  // Crossings, and the quads around them, have other numbers.
  void renumber(const std::vector<Crossing>& crossings);
  // The far quads of the last check, in order.
  std::vector<uint32_t> far_quads() const;
  // Places on borders that quads among them pass by.
  std::vector<Vec3> missed_borders() const;
  // Borders that no corner of the grid's cells sees and no facet is near. If they are more than `most`, none; they
  // count as far then. Nothing of the tree is cut. Throws Cancelled.
  std::vector<CrossedEdge> far_hidden_edges(const QuadSurface& surface, const CellTree& tree, size_t most);
  // At the samples, or a thousand of the far ones, at crossings and at hidden borders that count as far; 1 when all are
  // near. Throws Cancelled.
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

  // Of hidden borders, those that no facet is near, and where they are.
  void add_far_among(const std::vector<CrossedEdge>& hidden, const QuadSurface& surface, const CellTree& tree,
                     std::vector<CrossedEdge>& far, std::vector<Vec3>& places) const;
  void check_facets(const QuadSurface& surface, const std::vector<uint32_t>& quads);
  // As far as facets have to be near.
  std::vector<Ball> balls_around(const std::vector<FarBorder>& borders, const QuadSurface& surface) const;
  void keep_far_borders(const QuadSurface& surface, const std::vector<uint32_t>& changed);
  // Of those that were found, the ones that no facet is near.
  void add_far_borders(const QuadSurface& surface, std::vector<FarBorder> found);
  void check_crossings(const QuadSurface& surface, const std::vector<uint32_t>& changed);

  const Partition& partition_;
  double tolerance_mm_, reach_mm_, border_reach_mm_, spacing_mm_;
  int fine_level_;  // of cells no wider than the tolerance; -1: none
  Workers workers_;
  SeenQuads seen_;
  std::vector<Far> far_;                // in order of quads
  std::vector<FarBorder> far_borders_;  // in order of quads
  std::vector<uint32_t> far_crossings_;
  std::vector<Vec3> left_hidden_;  // some of them, if there are too many
};

}  // namespace ombre::surface

// Draws vertices together where the surface is flat, and takes apart what folds, lies too far off, or goes through
// other facets.
#pragma once

#include <vector>

#include "surface/mesh/facet_check.h"
#include "surface/mesh/intersections.h"
#include "surface/mesh/quad_surface.h"

namespace ombre::surface {

class SurfaceMaker {
 public:
  SurfaceMaker(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh,
               const ContourOptions& options, FacetCheck& check, IntersectionFinder& intersections);

  // As near as clusters that are taken apart bring it.
  void bring_near();
  // Leaves above level 0 around what lies too far off, and cells in which borders lie that facets pass by; the same
  // with leaves around facets that go through others. In any order, some more than once.
  Growth far_cells() const;
  Growth coarse_cells();
  // What the grid does not see; nothing of the tree is cut.
  std::vector<CrossedEdge> far_hidden_edges(size_t most) { return check_.far_hidden_edges(surface_, tree_, most); }
  // Fits volumes and mends intersections. Throws Cancelled.
  void finish(const Partition& partition);
  bool crosses_nowhere() const { return pairs_left_ == 0; }  // when finished
  // If finishing moved anything too far off, it goes back, and triangles may cross there. Throws Cancelled.
  void undo_far_moves();

  RegionSurface build() const;

 private:
  void note_leaf(uint32_t vertex, std::vector<uint32_t>& leaves) const;
  // Whether the vertex's cell is wider than the tolerance, corner to corner. In others nothing is far, and cuts would
  // only find finer waves to mend.
  bool is_wide(uint32_t vertex) const;
  void fit_volumes(const Partition& partition);
  void mend_intersections();
  std::vector<uint32_t> moved_around_far() const;
  void mend_folds();
  bool mend(const std::vector<uint32_t>& quads);
  bool mend(const QuadPairs& pairs);
  bool split_far();
  bool move_back(const std::vector<uint32_t>& vertices);
  bool is_far(uint32_t quad) const;
  // Leaves planes as few triangles as they need.
  void join_planes(RegionSurface& made) const;
  int rank(uint32_t cluster) const;

  const CellTree& tree_;
  const ContourOptions& options_;
  FacetCheck& check_;
  IntersectionFinder& intersections_;
  QuadSurface surface_;
  std::vector<Vec3> unfinished_;  // places, by cluster
  uint64_t at_mean_points_ = 0;
  size_t pairs_left_ = 0;
};

}  // namespace ombre::surface

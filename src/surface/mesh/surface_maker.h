// Joins vertices where the surface is flat, and splits clusters where it folds, is too far off or intersects itself.
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

  // Splits clusters until the surface is as close to the borders as that can make it.
  void bring_near();
  // far_cells() returns the leaves above level 0 around quads that are too far off, and the cells that contain borders
  // which facets miss. coarse_cells() adds the leaves around intersecting facets. Both are unordered and may contain
  // duplicates.
  Growth far_cells() const;
  Growth coarse_cells();
  // Returns borders that the grid does not show; no leaf of the tree may be subdivided yet.
  std::vector<CrossedEdge> far_hidden_edges(const EachHiddenEdge& each, size_t most) {
    return check_.far_hidden_edges(surface_, tree_, each, most);
  }
  // Fits volumes and mends intersections. Throws Cancelled.
  void finish(const Partition& partition);
  bool crosses_nowhere() const { return pairs_left_ == 0; }  // valid after finish()
  // Moves clusters back that finishing moved too far off; triangles may then intersect. Throws Cancelled.
  void undo_far_moves();

  RegionSurface build() const;

 private:
  void note_leaf(uint32_t vertex, std::vector<uint32_t>& leaves) const;
  // True if the diagonal of the vertex's cell is longer than the tolerance. Smaller cells cannot be too far off, and
  // subdividing them would only add smaller waves to mend.
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
  // Reduces the triangles in each plane to as few as it needs.
  void join_planes(RegionSurface& made) const;
  int rank(uint32_t cluster) const;

  const CellTree& tree_;
  const ContourOptions& options_;
  FacetCheck& check_;
  IntersectionFinder& intersections_;
  QuadSurface surface_;
  std::vector<Vec3> unfinished_;  // by cluster: its place before finishing
  uint64_t at_mean_points_ = 0;
  size_t pairs_left_ = 0;
};

}  // namespace ombre::surface

#include "surface/mesh/surface_maker.h"

#include <algorithm>
#include <cmath>

#include "surface/mesh/doubled_edges.h"
#include "surface/mesh/join_coplanar.h"
#include "surface/mesh/snap_to_planes.h"
#include "surface/mesh/unfold.h"
#include "surface/mesh/volume_fit.h"

namespace ombre::surface {
namespace {

constexpr int most_rounds = 40, most_crossing_rounds = 6, most_far_rounds = 12, most_fitting_rounds = 6,
              most_undoing_rounds = 6;
// Greatest distances of a plane's vertices from it, in tolerances. The first covers rounding and is negligible against
// the allowed deviation. The second covers the few vertices near edges that were found from mixed normals; facets are
// kept closer than the tolerance to leave room for it.
constexpr double coplanar_of_tolerance = 1e-3, nearly_coplanar_of_tolerance = 0.05;
// Rank of a vertex: clusters of the highest level are split first, vertices never.
constexpr int vertex_rank = -1;

}  // namespace

SurfaceMaker::SurfaceMaker(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh,
                           const ContourOptions& options, FacetCheck& check, IntersectionFinder& intersections)
    : tree_(tree),
      options_(options),
      check_(check),
      intersections_(intersections),
      surface_(tree, crossings, mesh, options) {}

void SurfaceMaker::bring_near() {
  int round = 0;
  do {
    mend_folds();
    check_.check(surface_);
  } while (++round < most_far_rounds && split_far());
}

Growth SurfaceMaker::far_cells() const {
  Growth far;
  for (const uint32_t quad : check_.far_quads())
    for (const uint32_t vertex : surface_.mesh().quads[quad].corners)
      note_leaf(surface_.mesh().vertices[vertex].leaf, far.cut);
  for (const Vec3& border : check_.missed_borders()) {
    const CellPlace unit = tree_.unit_at(border);
    if (const uint32_t leaf = tree_.find(unit); leaf != CellTree::none)
      note_leaf(leaf, far.cut);
    else if (tree_.is_within(unit))
      far.taken_in.push_back(grid_cell_of(unit));
  }
  return far;
}

Growth SurfaceMaker::coarse_cells() {
  Growth coarse = far_cells();
  for (const auto& [a, b] : intersections_.find(surface_))
    for (const uint32_t quad : {a, b})
      for (const uint32_t vertex : surface_.mesh().quads[quad].corners)
        if (surface_.clusters().of(vertex) == vertex && is_wide(vertex))
          note_leaf(surface_.mesh().vertices[vertex].leaf, coarse.cut);
  return coarse;
}

void SurfaceMaker::note_leaf(uint32_t leaf, std::vector<uint32_t>& leaves) const {
  if (tree_.leaves()[leaf].level > 0) leaves.push_back(leaf);
}

bool SurfaceMaker::is_wide(uint32_t vertex) const {
  const Leaf& leaf = tree_.leaves()[surface_.mesh().vertices[vertex].leaf];
  return length(tree_.size_mm(leaf.level)) > options_.tolerance_mm;
}

void SurfaceMaker::finish(const Partition& partition) {
  unfinished_ = surface_.clusters().places();
  fit_volumes(partition);
  mend_intersections();
}

// Fits the volumes, and undoes moves that take facets too far off or fold them.
void SurfaceMaker::fit_volumes(const Partition& partition) {
  VolumeFit fit(surface_, partition, options_.tolerance_mm, options_.workers);
  for (int round = 0; round < most_fitting_rounds; ++round) {
    surface_.refresh();
    check_.check(surface_);
    std::vector<uint32_t> wrong = surface_.folded_quads();
    const std::vector<uint32_t> far = check_.far_quads();
    wrong.insert(wrong.end(), far.begin(), far.end());
    if (!fit.undo(surface_, wrong)) return;
  }
}

void SurfaceMaker::mend_intersections() {
  mend_folds();
  unfold(surface_);
  QuadPairs pairs = intersections_.find(surface_);
  for (int round = 0; round < most_crossing_rounds && !pairs.empty() && mend(pairs); ++round) {
    mend_folds();
    pairs = intersections_.find(surface_);
  }
  pairs_left_ = pairs.size();
  check_.check(surface_);
}

void SurfaceMaker::undo_far_moves() {
  bool is_undone = false;
  for (int round = 0; round < most_undoing_rounds && check_.farthest_in_tolerances(surface_) > 1; ++round) {
    const std::vector<uint32_t> moved = moved_around_far();
    if (moved.empty()) break;
    for (const uint32_t cluster : moved) surface_.place(cluster, unfinished_[cluster]);
    surface_.refresh();
    check_.check(surface_);
    is_undone = true;
  }
  if (is_undone) pairs_left_ = intersections_.find(surface_).size();
}

// Returns the clusters around quads that are too far off which finishing has moved.
std::vector<uint32_t> SurfaceMaker::moved_around_far() const {
  std::vector<uint32_t> moved;
  for (const uint32_t quad : check_.far_quads())
    for (const uint32_t corner : surface_.mesh().quads[quad].corners)
      for (const uint32_t around : surface_.quads_around(corner))
        for (const uint32_t vertex : surface_.mesh().quads[around].corners) {
          const uint32_t cluster = surface_.clusters().of(vertex);
          if (surface_.clusters().places()[cluster] != unfinished_[cluster]) moved.push_back(cluster);
        }
  return moved;
}

void SurfaceMaker::join_planes(RegionSurface& made) const {
  const double exact_mm = coplanar_of_tolerance * options_.tolerance_mm;
  snap_to_planes(made, exact_mm, nearly_coplanar_of_tolerance * options_.tolerance_mm, options_.workers);
  join_coplanar(made, exact_mm, options_.workers);
}

RegionSurface SurfaceMaker::build() const {
  RegionSurface made = surface_.build();
  made.report.at_mean_points = at_mean_points_;
  made.report.intersections = pairs_left_;
  made.report.farthest_in_tolerances = check_.farthest_in_tolerances(surface_);
  if (options_.join_flat) join_planes(made);
  cut_doubled_edges(made);
  return made;
}

void SurfaceMaker::mend_folds() {
  for (int round = 0; round < most_rounds && mend(surface_.refresh()); ++round) options_.workers.check_stop();
  surface_.refresh();
}

// Splits clusters where the surface folds or is too far off; single vertices that fold it move to the mean of their
// crossings. Returns false if nothing had to be mended.
bool SurfaceMaker::mend(const std::vector<uint32_t>& quads) {
  std::vector<uint32_t> apart, back;
  for (const uint32_t quad : quads) {
    const std::span<const Triangle> triangles = surface_.triangles(quad);
    if (triangles.empty()) continue;
    const bool folds = surface_.is_folded(quad);
    if (!folds && !is_far(quad)) continue;
    uint32_t highest = triangles[0][0];
    for (const Triangle& triangle : triangles)
      for (const uint32_t corner : triangle)
        if (rank(corner) > rank(highest)) highest = corner;
    if (surface_.clusters().is_joined(highest))
      apart.push_back(highest);
    else if (folds)
      for (const Triangle& triangle : triangles) back.insert(back.end(), triangle.begin(), triangle.end());
  }
  for (const uint32_t cluster : apart) surface_.split(cluster);
  return move_back(back) || !apart.empty();
}

// Splits the clusters of intersecting triangles, and moves single vertices to the mean of their crossings. Returns
// false if nothing could be changed.
bool SurfaceMaker::mend(const QuadPairs& pairs) {
  std::vector<uint32_t> back;
  bool is_apart = false;
  for (const auto& [a, b] : pairs)
    for (const uint32_t quad : {a, b})
      for (const Triangle& triangle : surface_.triangles(quad))
        for (const uint32_t cluster : triangle) {
          if (surface_.clusters().is_joined(cluster)) {
            surface_.split(cluster);
            is_apart = true;
          } else {
            back.push_back(cluster);
          }
        }
  return move_back(back) || is_apart;
}

// Splits clusters where the surface is too far off. Returns false if there are none.
bool SurfaceMaker::split_far() {
  bool is_apart = false;
  std::vector<uint32_t> apart;
  for (const uint32_t quad : check_.far_quads()) {
    int highest = vertex_rank;
    const auto& corners = surface_.mesh().quads[quad].corners;
    for (const uint32_t vertex : corners) highest = std::max(highest, rank(surface_.clusters().of(vertex)));
    if (highest == vertex_rank) continue;
    for (const uint32_t vertex : corners) {
      const uint32_t cluster = surface_.clusters().of(vertex);
      if (rank(cluster) == highest) apart.push_back(cluster);
    }
    is_apart = true;
  }
  for (const uint32_t cluster : apart) surface_.split(cluster);
  return is_apart;
}

bool SurfaceMaker::move_back(const std::vector<uint32_t>& vertices) {
  bool moved = false;
  for (const uint32_t vertex : vertices) {
    const Vec3 mean = surface_.mesh().vertices[vertex].planes.mean();
    if (surface_.clusters().places()[vertex] == mean) continue;
    surface_.move(vertex, mean);
    ++at_mean_points_;
    moved = true;
  }
  return moved;
}

// True if the crossing is farther than the tolerance from the planes of all of the quad's triangles.
bool SurfaceMaker::is_far(uint32_t quad) const {
  const double reach = options_.join_flat ? options_.tolerance_mm : 0;
  return std::ranges::all_of(surface_.triangles(quad), [&](const Triangle& t) {
    const Vec3 n = surface_.normal(t);
    return std::abs(dot(n, surface_.crossing(quad).at - surface_.clusters().places()[t[0]])) > reach * length(n);
  });
}

int SurfaceMaker::rank(uint32_t cluster) const {
  return surface_.clusters().is_joined(cluster) ? surface_.clusters()[cluster].level : vertex_rank;
}

}  // namespace ombre::surface

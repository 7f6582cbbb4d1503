#include "surface/contour.h"

#include <algorithm>
#include <cmath>

#include "surface/clusters.h"
#include "surface/doubled_edges.h"
#include "surface/facet_check.h"
#include "surface/intersections.h"
#include "surface/refinement.h"

namespace ombre::surface {
namespace {

constexpr int most_rounds = 40, most_crossing_rounds = 6, most_far_rounds = 12, most_cutting_rounds = 3;
// That may come from cutting, or as many as the grid has, if that is more.
constexpr double most_cut_share = 0.1;  // at a time
constexpr size_t most_more_leaves = size_t{1} << 18;

// The corners of a quad after its vertices were drawn together: 0, 3 or 4 of them.
struct Polygon {
  std::array<uint32_t, 4> corners{};
  size_t count = 0;
};

Polygon without_repeats(const std::array<uint32_t, 4>& corners) {
  Polygon polygon;
  for (size_t n = 0; n < 4; ++n)
    if (corners[n] != corners[(n + 1) % 4]) polygon.corners[polygon.count++] = corners[n];
  const bool is_flat = corners[0] == corners[2] || corners[1] == corners[3];
  if (polygon.count < 3 || (is_flat && polygon.count != 3)) polygon.count = 0;
  return polygon;
}

using Triangle = std::array<uint32_t, 3>;

class SurfaceMaker {
 public:
  SurfaceMaker(const CellTree& tree, const std::vector<Crossing>& crossings, const DualMesh& mesh,
               const ContourOptions& options, FacetCheck& check)
      : tree_(tree),
        crossings_(crossings),
        mesh_(mesh),
        options_(options),
        check_(check),
        clusters_(tree, crossings, mesh, options.join_flat ? options.tolerance_mm : 0) {}

  // As near as clusters that are taken apart bring it.
  RegionSurface make() {
    check_.begin();
    RegionSurface made;
    int round = 0;
    do {
      mend_folds();
      made = build();
      check_.check(made, facet_begins_, crossings_);
    } while (++round < most_far_rounds && split_far());
    return made;
  }

  void mend_intersections(RegionSurface& made) {
    auto pairs = find_intersections(made.vertices, made.facets, options_.threads);
    if (pairs.empty()) return;
    for (int round = 0; round < most_crossing_rounds && !pairs.empty() && mend_intersections(made, pairs); ++round) {
      mend_folds();
      made = build();
      pairs = find_intersections(made.vertices, made.facets, options_.threads);
    }
    made.report.intersections = pairs.size();
    check_.begin();
    check_.check(made, facet_begins_, crossings_);
  }

  // Above level 0, where vertices that stand for themselves lie too far off, or their triangles go through others.
  std::vector<uint32_t> coarse_leaves(const RegionSurface& made) const {
    std::vector<uint32_t> leaves;
    const auto note = [&](uint32_t vertex) {
      const uint32_t leaf = mesh_.vertices[vertex].leaf;
      if (tree_.leaves()[leaf].level > 0) leaves.push_back(leaf);
    };
    for (const uint32_t quad : check_.far_quads())
      for (const uint32_t vertex : mesh_.quads[quad].corners) note(vertex);
    for (const auto& [a, b] : find_intersections(made.vertices, made.facets, options_.threads))
      for (const uint32_t facet : {a, b})
        for (const uint32_t corner : made.facets[facet].corners)
          if (!clusters_.is_joined(cluster_of_[corner])) note(cluster_of_[corner]);
    std::ranges::sort(leaves);
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    return leaves;
  }

 private:
  // Takes clusters apart where the surface lies too far off; false when there are none.
  bool split_far() {
    bool is_apart = false;
    for (const uint32_t quad : check_.far_quads()) {
      int highest = vertex_rank;
      for (const uint32_t vertex : mesh_.quads[quad].corners) highest = std::max(highest, rank(clusters_.of(vertex)));
      if (highest == vertex_rank) continue;
      for (const uint32_t vertex : mesh_.quads[quad].corners) {
        const uint32_t cluster = clusters_.of(vertex);
        if (rank(cluster) == highest) clusters_.split(cluster);
      }
      is_apart = true;
    }
    return is_apart;
  }

  Polygon polygon_of(const DualQuad& quad) const {
    std::array<uint32_t, 4> corners{};
    for (size_t n = 0; n < 4; ++n) corners[n] = clusters_.of(quad.corners[n]);
    return without_repeats(corners);
  }

  Vec3 normal_of(const Triangle& t) const {
    const Vec3 a = clusters_[t[0]].at;
    return cross(clusters_[t[1]].at - a, clusters_[t[2]].at - a);
  }

  // How well two triangles look along the border's normal, and the least of their heights, mm.
  struct Fit {
    double agreement = 1, height = 1e300;
  };
  Fit fit_of(const std::array<Triangle, 2>& triangles, Vec3 normal) const {
    Fit fit;
    for (const Triangle& t : triangles) {
      const Vec3 n = normal_of(t);
      double longest = 1e-300;
      for (size_t side = 0; side < 3; ++side)
        longest = std::max(longest, length(clusters_[t[(side + 1) % 3]].at - clusters_[t[side]].at));
      fit.agreement = std::min(fit.agreement, dot(n, normal) / std::max(length(n), 1e-300));
      fit.height = std::min(fit.height, length(n) / longest);
    }
    return fit;
  }

  // Cut along the diagonal that follows the border better, or leaves no slivers.
  std::vector<Triangle> triangles_of(const Polygon& p, const Crossing& crossing) const {
    const auto& c = p.corners;
    if (p.count == 0) return {};
    if (p.count == 3) return {{c[0], c[1], c[2]}};
    const std::array<Triangle, 2> first{{{c[0], c[1], c[2]}, {c[0], c[2], c[3]}}};
    const std::array<Triangle, 2> second{{{c[0], c[1], c[3]}, {c[1], c[2], c[3]}}};
    const Fit a = fit_of(first, crossing.normal), b = fit_of(second, crossing.normal);
    constexpr double about_equal = 0.1;
    const bool take_first =
        std::abs(a.agreement - b.agreement) > about_equal ? a.agreement > b.agreement : a.height >= b.height;
    const auto& taken = take_first ? first : second;
    return {taken.begin(), taken.end()};
  }

  bool is_folded(const Triangle& t, const Crossing& crossing) const {
    const Vec3 n = normal_of(t);
    return dot(n, crossing.normal) < -1e-9 * length(n);
  }

  double join_tolerance() const { return options_.join_flat ? options_.tolerance_mm : 0; }

  // Whether the crossing is farther from the triangles' planes than the tolerance.
  bool is_far(const std::vector<Triangle>& triangles, const Crossing& crossing) const {
    return std::ranges::all_of(triangles, [&](const Triangle& t) {
      const Vec3 n = normal_of(t);
      return std::abs(dot(n, crossing.at - clusters_[t[0]].at)) > join_tolerance() * length(n);
    });
  }

  RegionSurface build() {
    RegionSurface made;
    number_.assign(clusters_.size(), Cluster::none);
    cluster_of_.clear();
    facet_begins_ = {0};
    for (const DualQuad& quad : mesh_.quads) add(quad, made);
    made.report.at_mean_points = at_mean_points_;
    return made;
  }

  void mend_folds() {
    for (int round = 0; round < most_rounds && mend(); ++round) {
    }
  }

  // The same for triangles that go through each other.
  bool mend_intersections(const RegionSurface& made, const std::vector<std::pair<uint32_t, uint32_t>>& pairs) {
    std::vector<uint32_t> back;
    bool is_apart = false;
    for (const auto& [a, b] : pairs)
      for (const uint32_t facet : {a, b})
        for (const uint32_t corner : made.facets[facet].corners) {
          const uint32_t cluster = cluster_of_[corner];
          if (clusters_.is_joined(cluster)) {
            clusters_.split(cluster);
            is_apart = true;
          } else {
            back.push_back(cluster);
          }
        }
    return move_back(back) || is_apart;
  }

  // Takes clusters apart where the surface folds or lies too far off; single vertices that fold it go to the mean of
  // their crossings. False when there was nothing to mend.
  bool mend() {
    std::vector<uint32_t> apart, back;
    for (const DualQuad& quad : mesh_.quads) {
      const Crossing& crossing = crossings_[quad.crossing];
      const Polygon polygon = polygon_of(quad);
      const auto triangles = triangles_of(polygon, crossing);
      const bool folds = std::ranges::any_of(triangles, [&](const Triangle& t) { return is_folded(t, crossing); });
      if (!folds && (triangles.empty() || !is_far(triangles, crossing))) continue;
      const uint32_t highest = *std::max_element(polygon.corners.begin(),
                                                 polygon.corners.begin() + static_cast<std::ptrdiff_t>(polygon.count),
                                                 [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
      if (clusters_.is_joined(highest))
        apart.push_back(highest);
      else if (folds)
        back.insert(back.end(), polygon.corners.begin(),
                    polygon.corners.begin() + static_cast<std::ptrdiff_t>(polygon.count));
    }
    for (const uint32_t c : apart) clusters_.split(c);
    return move_back(back) || !apart.empty();
  }

  // Clusters of the highest level are taken apart first, vertices never.
  static constexpr int vertex_rank = -1;
  int rank(uint32_t cluster) const { return clusters_.is_joined(cluster) ? clusters_[cluster].level : vertex_rank; }

  bool move_back(std::vector<uint32_t>& vertices) {
    bool moved = false;
    for (const uint32_t v : vertices) {
      const Vec3 mean = mesh_.vertices[v].planes.mean();
      if (clusters_[v].at == mean) continue;
      clusters_.move(v, mean);
      ++at_mean_points_;
      moved = true;
    }
    return moved;
  }

  void add(const DualQuad& quad, RegionSurface& made) {
    const Crossing& crossing = crossings_[quad.crossing];
    for (Triangle t : triangles_of(polygon_of(quad), crossing)) {
      made.report.folded += is_folded(t, crossing);
      for (uint32_t& corner : t) corner = vertex_of(corner, made);
      made.facets.push_back({t, crossing.edge.from, crossing.edge.to});
    }
    facet_begins_.push_back(static_cast<uint32_t>(made.facets.size()));
  }

  uint32_t vertex_of(uint32_t cluster, RegionSurface& made) {
    if (number_[cluster] == Cluster::none) {
      number_[cluster] = static_cast<uint32_t>(made.vertices.size());
      made.vertices.push_back(clusters_[cluster].at);
      cluster_of_.push_back(cluster);
    }
    return number_[cluster];
  }

  const CellTree& tree_;
  const std::vector<Crossing>& crossings_;
  const DualMesh& mesh_;
  const ContourOptions& options_;
  FacetCheck& check_;
  Clusters clusters_;
  FacetBegins facet_begins_;
  std::vector<uint32_t> number_;      // of a cluster's vertex
  std::vector<uint32_t> cluster_of_;  // of a vertex
  uint64_t at_mean_points_ = 0;
};

// The cells of a partition, with what is known of them, cut where one vertex for each is too few.
class CellRefiner {
 public:
  CellRefiner(const Partition& partition, const ContourOptions& options, Progress* progress, const StopFlag* stop)
      : partition_(partition),
        options_(options),
        stop_(stop),
        tree_(find_mixed_cells(partition.label, options.corners, options.threads, progress, stop)),
        most_leaves_(tree_.leaves().size() + std::max(most_more_leaves, tree_.leaves().size())),
        crossings_(find_crossings(partition, tree_, {}, options.threads, progress, stop)),
        mesh_(make_dual_mesh(tree_, crossings_)) {}

  RegionSurface make() {
    for (int round = 0; round < grid_level; ++round)
      if (!cut(find_coarse_leaves(tree_, mesh_, options_.tolerance_mm))) break;
    FacetCheck check(partition_, options_, stop_);
    for (int round = 0;; ++round) {
      SurfaceMaker maker(tree_, crossings_, mesh_, options_, check);
      RegionSurface made = maker.make();
      if (round < most_cutting_rounds && cut(maker.coarse_leaves(made))) continue;
      maker.mend_intersections(made);
      made.report.farthest_in_tolerances = check.farthest_in_tolerances();
      cut_doubled_edges(made);
      return made;
    }
  }

 private:
  // False when there is nothing to cut, or so much that the whole grid is too coarse.
  bool cut(const std::vector<uint32_t>& leaves) {
    const double all = static_cast<double>(tree_.leaves().size());
    if (leaves.empty() || static_cast<double>(leaves.size()) > most_cut_share * all ||
        tree_.leaves().size() >= most_leaves_)
      return false;
    refine(tree_, leaves, most_leaves_, partition_, options_.threads, stop_);
    crossings_ = find_crossings(partition_, tree_, crossings_, options_.threads, nullptr, stop_);
    mesh_ = make_dual_mesh(tree_, crossings_);
    return true;
  }

  const Partition& partition_;
  const ContourOptions& options_;
  const StopFlag* stop_;
  CellTree tree_;
  size_t most_leaves_;
  std::vector<Crossing> crossings_;
  DualMesh mesh_;
};

}  // namespace

RegionSurface contour(const Partition& partition, const ContourOptions& options, Progress* progress,
                      const StopFlag* stop) {
  return CellRefiner(partition, options, progress, stop).make();
}

}  // namespace ombre::surface

#include "surface/contour.h"

#include <algorithm>
#include <cmath>

#include "surface/clusters.h"
#include "surface/intersections.h"

namespace ombre::surface {
namespace {

constexpr int most_rounds = 40, most_crossing_rounds = 6;

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
  SurfaceMaker(const MixedCells& cells, const std::vector<Crossing>& crossings, const DualMesh& mesh,
               double tolerance_mm)
      : crossings_(crossings),
        mesh_(mesh),
        tolerance_mm_(tolerance_mm),
        clusters_(cells, crossings, mesh, tolerance_mm) {}

  RegionSurface make(int threads) {
    mend_folds();
    RegionSurface made = build();
    auto pairs = find_intersections(made.vertices, made.facets, threads);
    for (int round = 0; round < most_crossing_rounds && !pairs.empty() && mend_intersections(made, pairs); ++round) {
      mend_folds();
      made = build();
      pairs = find_intersections(made.vertices, made.facets, threads);
    }
    made.report.intersections = pairs.size();
    return made;
  }

 private:
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

  // Whether the crossing is farther from the triangles' planes than the tolerance.
  bool is_far(const std::vector<Triangle>& triangles, const Crossing& crossing) const {
    return std::ranges::all_of(triangles, [&](const Triangle& t) {
      const Vec3 n = normal_of(t);
      return std::abs(dot(n, crossing.at - clusters_[t[0]].at)) > tolerance_mm_ * length(n);
    });
  }

  RegionSurface build() {
    RegionSurface made;
    number_.assign(clusters_.size(), Cluster::none);
    cluster_of_.clear();
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
          if (clusters_[cluster].level == 0) {
            back.push_back(cluster);
          } else {
            clusters_.split(cluster);
            is_apart = true;
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
      const uint32_t highest = *std::max_element(
          polygon.corners.begin(), polygon.corners.begin() + static_cast<std::ptrdiff_t>(polygon.count),
          [&](uint32_t a, uint32_t b) { return clusters_[a].level < clusters_[b].level; });
      if (clusters_[highest].level > 0)
        apart.push_back(highest);
      else if (folds)
        back.insert(back.end(), polygon.corners.begin(),
                    polygon.corners.begin() + static_cast<std::ptrdiff_t>(polygon.count));
    }
    for (const uint32_t c : apart) clusters_.split(c);
    return move_back(back) || !apart.empty();
  }

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
      made.facets.push_back({t, crossing.from, crossing.to});
    }
  }

  uint32_t vertex_of(uint32_t cluster, RegionSurface& made) {
    if (number_[cluster] == Cluster::none) {
      number_[cluster] = static_cast<uint32_t>(made.vertices.size());
      made.vertices.push_back(clusters_[cluster].at);
      cluster_of_.push_back(cluster);
    }
    return number_[cluster];
  }

  const std::vector<Crossing>& crossings_;
  const DualMesh& mesh_;
  double tolerance_mm_;
  Clusters clusters_;
  std::vector<uint32_t> number_;      // of a cluster's vertex
  std::vector<uint32_t> cluster_of_;  // of a vertex
  uint64_t at_mean_points_ = 0;
};

}  // namespace

RegionSurface contour(const Partition& partition, const ContourOptions& options, Progress* progress,
                      const StopFlag* stop) {
  const MixedCells cells = find_mixed_cells(partition.label, options.corners, options.threads, progress, stop);
  const std::vector<Crossing> crossings = find_crossings(partition, cells, options.threads, progress, stop);
  const DualMesh mesh = make_dual_mesh(cells, crossings);
  return SurfaceMaker(cells, crossings, mesh, options.tolerance_mm).make(options.threads);
}

}  // namespace ombre::surface

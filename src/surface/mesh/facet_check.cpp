#include "surface/mesh/facet_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/math/evenly_spaced.h"
#include "surface/mesh/border_offsets.h"
#include "surface/mesh/deep_borders.h"
#include "surface/mesh/side_normals.h"

namespace ombre::surface {
namespace {

// share of the tolerance that is checked, because samples see only part of a facet
constexpr double reach_of_tolerance = 0.88;
// share for deep borders if cells are wide; smaller, because samples see less of them
constexpr double border_reach_of_tolerance = 0.66;
constexpr double small_of_reach = 0.5;  // longest side, in reaches, of facets that need few samples
constexpr double most_tolerances = 16;
constexpr double sharp_cosine = 0.5;  // cosine between the normals of two facets below which their side is a crease
constexpr double least_sum = 1e-6;    // least length of a sum of normals that still has a direction
constexpr size_t most_measured = 1000;
constexpr size_t quads_at_once = size_t{1} << 16;  // limits memory

double longest_side(const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  return std::max({length(b - a), length(c - b), length(a - c)});
}

Vec3 middle_of(const std::array<Vec3, 3>& corners) { return (1.0 / 3) * (corners[0] + corners[1] + corners[2]); }

class Sampler {
 public:
  Sampler(const QuadSurface& surface, double spacing_mm, double small_mm)
      : surface_(surface), spacing_mm_(spacing_mm), small_mm_(small_mm), has_vertex_(surface.clusters().size()) {}

  // Adds samples of a quad: one if it is calm, since little can be wrong there; fewer than usual if it is small.
  void add(uint32_t quad) {
    quad_ = quad;
    is_seen_from_less_ = surface_.crossing(quad).edge.from < surface_.crossing(quad).edge.to;
    const bool is_calm = surface_.is_calm(quad);
    for (const Triangle& triangle : surface_.triangles(quad)) {
      const std::array<Vec3, 3> corners = surface_.corners(triangle);
      const Vec3 across = surface_.normal(triangle);
      const double twice_area = length(across);
      normal_ = twice_area > 0 ? (1 / twice_area) * across : Vec3{0, 0, 1};
      add(middle_of(corners));
      if (is_calm) return;
      add_vertices(triangle, corners);
      if (longest_side(corners) <= small_mm_) continue;
      add_sides(triangle, corners);
      add_inside(corners, twice_area);
    }
  }

  void clear() {
    quads.clear();
    samples.clear();
  }

  std::vector<uint32_t> quads;  // quad number of each sample
  std::vector<SurfaceSample> samples;

 private:
  void add(Vec3 at) {
    quads.push_back(quad_);
    samples.push_back({at, normal_});
  }

  // Adds each vertex once.
  void add_vertices(const Triangle& triangle, const std::array<Vec3, 3>& corners) {
    for (size_t n = 0; n < 3; ++n) {
      if (!has_vertex_[triangle[n]]) add(corners[n]);
      has_vertex_[triangle[n]] = true;
    }
  }

  // Adds each side once: its two facets, seen from the same region, run along it in opposite directions.
  void add_sides(const Triangle& triangle, const std::array<Vec3, 3>& corners) {
    for (size_t n = 0; n < 3; ++n) {
      const uint32_t next = triangle[(n + 1) % 3];
      if ((triangle[n] < next) == is_seen_from_less_) add_side(corners[n], corners[(n + 1) % 3]);
      add_crease(std::minmax(triangle[n], next), corners[n], corners[(n + 1) % 3]);
    }
  }

  // Samples a sharp side a second time when its second facet arrives, with the mean of both facets' normals.
  void add_crease(std::pair<uint32_t, uint32_t> side, Vec3 from, Vec3 to) {
    const Vec3 facet_normal = normal_, seen_from_less = is_seen_from_less_ ? normal_ : -1.0 * normal_;
    const auto [other, is_first] = facets_.keep(side.first, side.second, seen_from_less);
    if (is_first || dot(other, seen_from_less) > sharp_cosine) return;
    const Vec3 both = other + seen_from_less;
    const double size = length(both);
    if (size < least_sum) return;
    normal_ = (1 / size) * both;
    add(from);
    add(to);
    add_side(from, to);
    normal_ = facet_normal;
  }

  int pieces(double length_mm) const {
    constexpr double most_pieces = 1000;
    return static_cast<int>(std::min(std::ceil(length_mm / spacing_mm_), most_pieces));
  }

  void add_side(Vec3 from, Vec3 to) {
    const int count = std::max(2, pieces(length(to - from)));
    for (int n = 1; n < count; ++n) add(from + (static_cast<double>(n) / count) * (to - from));
  }

  void add_inside(const std::array<Vec3, 3>& corners, double twice_area) {
    const auto& [a, b, c] = corners;
    const int count = pieces(std::min(longest_side(corners), std::sqrt(twice_area)));
    for (int i = 1; i < count; ++i)
      for (int j = 1; i + j < count; ++j)
        add(a + (static_cast<double>(i) / count) * (b - a) + (static_cast<double>(j) / count) * (c - a));
  }

  const QuadSurface& surface_;
  double spacing_mm_, small_mm_;
  std::vector<bool> has_vertex_;
  SideNormals facets_;
  Vec3 normal_;
  uint32_t quad_ = 0;
  bool is_seen_from_less_ = true;
};

// Returns a vector along the edge's axis with that component of `lengths`.
Vec3 along(const CrossedEdge& edge, const Vec3& lengths) {
  Vec3 way;
  way[edge.axis] = lengths[edge.axis];
  return way;
}

// Returns the values, sorted by quad, with the new numbers of their quads; values of quads that no longer exist are
// dropped.
template <class T>
std::vector<T> renumbered(const std::vector<T>& before, const std::vector<Crossing>& crossings) {
  std::vector<T> now;
  for (uint32_t n = 0; n < crossings.size(); ++n) {
    const uint32_t quad = crossings[n].before;
    if (quad == Crossing::none) continue;
    for (auto at = std::ranges::lower_bound(before, quad, {}, &T::quad); at != before.end() && at->quad == quad; ++at) {
      now.push_back(*at);
      now.back().quad = n;
    }
  }
  return now;
}

// Returns the greatest distance from the places to the facets, at most `most_mm`. The reach grows in steps, because a
// long reach makes the search among facets expensive.
double farthest_from_facets(std::vector<Vec3> places, const QuadSurface& surface, double reach_mm, double most_mm,
                            const Workers& workers) {
  double farthest = 0;
  while (!places.empty()) {
    std::vector<Vec3> beyond;
    const std::vector<double> distances = distances_to_facets(places, surface, reach_mm, workers);
    for (size_t n = 0; n < places.size(); ++n) {
      if (distances[n] <= reach_mm)
        farthest = std::max(farthest, distances[n]);
      else
        beyond.push_back(places[n]);
    }
    if (!beyond.empty() && reach_mm >= most_mm) return most_mm;
    reach_mm = std::min(2 * reach_mm, most_mm);
    places = std::move(beyond);
  }
  return farthest;
}

// Returns the greatest level whose cells are no wider than `width_mm`, or -1 if there is none.
int level_within(double width_mm, double grid_cell_mm) {
  int level = grid_level;
  for (double cell_mm = grid_cell_mm; level >= 0 && cell_mm > width_mm; cell_mm /= 2) --level;
  return level;
}

std::vector<Ball> balls_at(const std::vector<Vec3>& places, double radius_mm) {
  std::vector<Ball> balls;
  balls.reserve(places.size());
  for (const Vec3& place : places) balls.push_back({place, radius_mm});
  return balls;
}

template <class T>
void remove_where(const std::vector<bool>& flags, std::vector<T>& values) {
  size_t kept = 0;
  for (size_t n = 0; n < values.size(); ++n)
    if (!flags[n]) values[kept++] = values[n];
  values.resize(kept);
}

std::vector<Vec3> crossings_of(const std::vector<uint32_t>& crossings, const QuadSurface& surface) {
  std::vector<Vec3> places;
  places.reserve(crossings.size());
  for (const uint32_t n : crossings) places.push_back(surface.crossing(n).at);
  return places;
}

}  // namespace

FacetCheck::FacetCheck(const Partition& partition, const ContourOptions& options)
    : partition_(partition),
      tolerance_mm_(options.tolerance_mm),
      reach_mm_(reach_of_tolerance * options.tolerance_mm),
      border_reach_mm_(border_reach_of_tolerance * options.tolerance_mm),
      spacing_mm_(0.5 * options.corners.pitch[0].mm()),
      fine_level_(level_within(options.tolerance_mm, options.corners.pitch[0].mm())),
      workers_(options.workers) {}

void FacetCheck::check(const QuadSurface& surface) {
  const std::vector<uint32_t> quads = seen_.see(surface.shape_hashes());
  check_facets(surface, quads);
  check_crossings(surface, quads);
}

void FacetCheck::check_facets(const QuadSurface& surface, const std::vector<uint32_t>& quads) {
  const auto is_seen = [&](const auto& far) { return std::ranges::binary_search(quads, far.quad); };
  std::erase_if(far_, is_seen);
  std::erase_if(far_borders_, is_seen);
  keep_far_borders(surface, quads);
  std::vector<FarBorder> found_borders;
  Sampler sampler(surface, spacing_mm_, small_of_reach * reach_mm_);
  for (size_t begin = 0; begin < quads.size(); begin += quads_at_once) {
    sampler.clear();
    for (size_t n = begin; n < std::min(begin + quads_at_once, quads.size()); ++n) {
      workers_.check_stop_at(n);
      sampler.add(quads[n]);
    }
    const FarSamples found = find_far_samples(partition_, sampler.samples, reach_mm_, workers_.threads, workers_.stop);
    for (const uint32_t n : found.far) far_.push_back({sampler.quads[n], sampler.samples[n]});
    for (const DeepBorder& deep : find_deep_borders(partition_, sampler.samples, found.beside, border_reach_mm_,
                                                    workers_.threads, workers_.stop))
      found_borders.push_back({sampler.quads[deep.sample], deep.at});
  }
  add_far_borders(surface, std::move(found_borders));
  std::ranges::stable_sort(far_, {}, &Far::quad);
  std::ranges::stable_sort(far_borders_, {}, &FarBorder::quad);
}

std::vector<Ball> FacetCheck::balls_around(const std::vector<FarBorder>& borders, const QuadSurface& surface) const {
  std::vector<Ball> balls;
  balls.reserve(borders.size());
  for (const FarBorder& border : borders) {
    const bool is_fine = surface.crossing(border.quad).edge.level <= fine_level_;
    balls.push_back({border.at, is_fine ? reach_mm_ : border_reach_mm_});
  }
  return balls;
}

// Only changed quads can have come near to these borders.
void FacetCheck::keep_far_borders(const QuadSurface& surface, const std::vector<uint32_t>& changed) {
  const std::vector<bool> near = meet_facets(balls_around(far_borders_, surface), surface, changed, workers_);
  remove_where(near, far_borders_);
}

void FacetCheck::add_far_borders(const QuadSurface& surface, std::vector<FarBorder> found) {
  remove_where(meet_facets(balls_around(found, surface), surface, workers_), found);
  far_borders_.insert(far_borders_.end(), found.begin(), found.end());
  std::ranges::stable_sort(far_borders_, {}, &FarBorder::quad);
}

void FacetCheck::check_crossings(const QuadSurface& surface, const std::vector<uint32_t>& changed) {
  const std::vector<uint32_t>& before = far_crossings_;
  std::vector<uint32_t> still, off;
  std::ranges::set_difference(before, changed, std::back_inserter(still));
  std::ranges::copy_if(changed, std::back_inserter(off), [&](uint32_t quad) {
    return std::ranges::none_of(surface.triangles(quad), [&](const Triangle& triangle) {
      return distance_to_triangle(surface.crossing(quad).at, surface.corners(triangle)) <= reach_mm_;
    });
  });
  // Only changed quads can have come near to the crossings that were far before.
  remove_where(meet_facets(balls_at(crossings_of(still, surface), reach_mm_), surface, changed, workers_), still);
  remove_where(meet_facets(balls_at(crossings_of(off, surface), reach_mm_), surface, workers_), off);
  far_crossings_.clear();
  std::ranges::merge(still, off, std::back_inserter(far_crossings_));
}

std::vector<CrossedEdge> FacetCheck::far_hidden_edges(const QuadSurface& surface, const CellTree& tree,
                                                      const EachHiddenEdge& each, size_t most) {
  std::vector<CrossedEdge> far;
  std::vector<Vec3> places;
  each([&](const std::vector<CrossedEdge>& hidden) {
    add_far_among(hidden, surface, tree, far, places);
    return far.size() <= most;
  });
  if (far.size() <= most) return far;
  left_hidden_ = evenly_spaced(places, most_measured);
  return {};
}

// Checks the middles of the edges first, because most hidden edges belong to bumps of a face that is near.
void FacetCheck::add_far_among(const std::vector<CrossedEdge>& hidden, const QuadSurface& surface, const CellTree& tree,
                               std::vector<CrossedEdge>& far, std::vector<Vec3>& places) const {
  double half_mm = 0;  // upper limit
  std::vector<Vec3> middles;
  for (const CrossedEdge& edge : hidden) {
    const Vec3 edge_mm = along(edge, tree.size_mm(edge.level));
    half_mm = std::max(half_mm, 0.5 * length(edge_mm));
    middles.push_back(tree.point(edge.start) + 0.5 * edge_mm);
  }
  const std::vector<bool> near = meet_facets(balls_at(middles, reach_mm_ - half_mm), surface, workers_);
  std::vector<CrossedEdge> left;
  std::vector<BorderSample> samples;
  for (size_t n = 0; n < hidden.size(); ++n) {
    if (near[n]) continue;
    left.push_back(hidden[n]);
    samples.push_back({middles[n], along(hidden[n], {1, 1, 1}), hidden[n].from, hidden[n].to});
  }
  const auto offsets = border_offsets(partition_, samples, half_mm, workers_.threads, workers_.stop);
  std::vector<Vec3> borders;
  for (size_t n = 0; n < samples.size(); ++n)
    borders.push_back(samples[n].at + offsets[n].value_or(0) * samples[n].normal);
  const std::vector<bool> near_borders = meet_facets(balls_at(borders, reach_mm_), surface, workers_);
  remove_where(near_borders, left);
  remove_where(near_borders, borders);
  far.insert(far.end(), left.begin(), left.end());
  places.insert(places.end(), borders.begin(), borders.end());
}

void FacetCheck::renumber(const std::vector<Crossing>& crossings) {
  seen_.renumber(crossings);
  far_ = renumbered(far_, crossings);
  far_borders_ = renumbered(far_borders_, crossings);
  std::vector<uint32_t> far_crossings;
  for (uint32_t n = 0; n < crossings.size(); ++n)
    if (crossings[n].before != Crossing::none && std::ranges::binary_search(far_crossings_, crossings[n].before))
      far_crossings.push_back(n);
  far_crossings_ = std::move(far_crossings);
}

std::vector<uint32_t> FacetCheck::far_quads() const {
  std::vector<uint32_t> quads = far_crossings_;
  for (const Far& far : far_) quads.push_back(far.quad);
  for (const FarBorder& border : far_borders_) quads.push_back(border.quad);
  std::ranges::sort(quads);
  quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
  return quads;
}

std::vector<Vec3> FacetCheck::missed_borders() const {
  std::vector<Vec3> places;
  places.reserve(far_borders_.size());
  for (const FarBorder& border : far_borders_) places.push_back(border.at);
  return places;
}

double FacetCheck::farthest_in_tolerances(const QuadSurface& surface) const {
  std::vector<SurfaceSample> samples;
  for (const Far& far : far_) samples.push_back(far.sample);
  samples = evenly_spaced(samples, most_measured);
  const double most = most_tolerances * tolerance_mm_;
  double farthest = tolerance_mm_;
  std::vector<Vec3> borders = missed_borders();
  for (const uint32_t n : far_crossings_) borders.push_back(surface.crossing(n).at);
  borders.insert(borders.end(), left_hidden_.begin(), left_hidden_.end());
  farthest = std::max(farthest, farthest_from_facets(std::move(borders), surface, tolerance_mm_, most, workers_));
  return std::max(farthest, farthest_mm(partition_, samples, tolerance_mm_, workers_.threads, workers_.stop)) /
         tolerance_mm_;
}

}  // namespace ombre::surface

#include "surface/facet_check.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "surface/box_tree.h"
#include "surface/evenly.h"

namespace ombre::surface {
namespace {

constexpr double reach_of_tolerance = 0.95;  // samples see but a part of a facet
constexpr double most_tolerances = 16;
constexpr size_t most_measured = 1000;

std::array<Vec3, 3> corners_of(const RegionSurface& surface, const Facet& facet) {
  return {surface.vertices[facet.corners[0]], surface.vertices[facet.corners[1]], surface.vertices[facet.corners[2]]};
}

uint64_t hash_of(const std::array<Vec3, 3>& corners) {
  uint64_t hash = 0;
  for (const Vec3& corner : corners)
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<uint64_t>(corner[axis])) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 32;
    }
  return hash;
}

class Sampler {
 public:
  Sampler(const RegionSurface& surface, double spacing_mm)
      : surface_(surface), spacing_mm_(spacing_mm), has_vertex_(surface.vertices.size()) {}

  // Vertices once, sides once where two facets go along them in opposite directions, and points inside.
  void add(uint32_t quad, uint64_t hash, const Facet& facet) {
    const std::array<Vec3, 3> corners = corners_of(surface_, facet);
    const Vec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double twice_area = length(across);
    normal_ = twice_area > 0 ? (1 / twice_area) * across : Vec3{0, 0, 1};
    owner_ = {quad, hash};
    for (size_t n = 0; n < 3; ++n) {
      if (!has_vertex_[facet.corners[n]]) add(corners[n]);
      has_vertex_[facet.corners[n]] = true;
      if (facet.corners[n] < facet.corners[(n + 1) % 3]) add_side(corners[n], corners[(n + 1) % 3]);
    }
    add((1.0 / 3) * (corners[0] + corners[1] + corners[2]));
    add_inside(corners, twice_area);
  }

  struct Owner {
    uint32_t quad = 0;
    uint64_t hash = 0;  // of the facet
  };
  std::vector<Owner> owners;
  std::vector<SurfaceSample> samples;

 private:
  void add(Vec3 at) {
    owners.push_back(owner_);
    samples.push_back({at, normal_});
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
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    const int count = pieces(std::min(longest, std::sqrt(twice_area)));
    for (int i = 1; i < count; ++i)
      for (int j = 1; i + j < count; ++j)
        add(a + (static_cast<double>(i) / count) * (b - a) + (static_cast<double>(j) / count) * (c - a));
  }

  const RegionSurface& surface_;
  double spacing_mm_;
  std::vector<bool> has_vertex_;
  Vec3 normal_;
  Owner owner_;
};

// The facets near a point.
class NearFacets {
 public:
  explicit NearFacets(const RegionSurface& surface) : surface_(surface), tree_(boxes_of(surface)) {}

  // To the nearest facet within reach; infinite when there is none.
  double distance(Vec3 point, double reach_mm) const {
    double nearest = HUGE_VAL;
    tree_.each_that_meets(Box{point, point}.expanded(reach_mm), [&](uint32_t facet) {
      nearest = std::min(nearest, distance_to_triangle(point, corners_of(surface_, surface_.facets[facet])));
    });
    return nearest;
  }

 private:
  static std::vector<Box> boxes_of(const RegionSurface& surface) {
    std::vector<Box> boxes;
    boxes.reserve(surface.facets.size());
    for (const Facet& facet : surface.facets) {
      const std::array<Vec3, 3> corners = corners_of(surface, facet);
      boxes.push_back(hull(hull({corners[0], corners[0]}, {corners[1], corners[1]}), {corners[2], corners[2]}));
    }
    return boxes;
  }

  const RegionSurface& surface_;
  BoxTree tree_;
};

}  // namespace

FacetCheck::FacetCheck(const Partition& partition, const ContourOptions& options, const StopFlag* stop)
    : partition_(partition),
      tolerance_mm_(options.tolerance_mm),
      reach_mm_(reach_of_tolerance * options.tolerance_mm),
      spacing_mm_(options.corners.pitch[0].mm()),
      threads_(options.threads),
      stop_(stop) {}

void FacetCheck::check(const RegionSurface& surface, const FacetBegins& begins,
                       const std::vector<Crossing>& crossings) {
  far_.clear();
  check_facets(surface, begins);
  check_crossings(surface, begins, crossings);
}

void FacetCheck::check_facets(const RegionSurface& surface, const FacetBegins& begins) {
  Sampler sampler(surface, spacing_mm_);
  for (uint32_t quad = 0; quad + 1 < begins.size(); ++quad)
    for (uint32_t facet = begins[quad]; facet < begins[quad + 1]; ++facet) {
      const uint64_t hash = hash_of(corners_of(surface, surface.facets[facet]));
      if (const auto known = known_far_.find(hash); known != known_far_.end()) {
        far_.push_back({quad, known->second, 0});
        continue;
      }
      if (!near_.insert(hash).second) continue;
      sampler.add(quad, hash, surface.facets[facet]);
    }
  for (const uint32_t n : find_far_samples(partition_, sampler.samples, reach_mm_, threads_, stop_)) {
    far_.push_back({sampler.owners[n].quad, sampler.samples[n], 0});
    near_.erase(sampler.owners[n].hash);
    known_far_.emplace(sampler.owners[n].hash, sampler.samples[n]);
  }
}

void FacetCheck::check_crossings(const RegionSurface& surface, const FacetBegins& begins,
                                 const std::vector<Crossing>& crossings) {
  near_crossings_.resize(crossings.size());
  std::vector<uint32_t> off;
  for (uint32_t quad = 0; quad + 1 < begins.size(); ++quad) {
    for (uint32_t facet = begins[quad]; facet < begins[quad + 1] && !near_crossings_[quad]; ++facet)
      near_crossings_[quad] =
          distance_to_triangle(crossings[quad].at, corners_of(surface, surface.facets[facet])) <= reach_mm_;
    if (!near_crossings_[quad]) off.push_back(quad);
  }
  if (off.empty()) return;
  const NearFacets facets(surface);
  for (const uint32_t quad : off) {
    near_crossings_[quad] = facets.distance(crossings[quad].at, reach_mm_) <= reach_mm_;
    if (near_crossings_[quad]) continue;
    const double most = most_tolerances * tolerance_mm_;
    far_.push_back({quad, {}, std::min(facets.distance(crossings[quad].at, most), most)});
  }
}

std::vector<uint32_t> FacetCheck::far_quads() const {
  std::vector<uint32_t> quads;
  for (const Far& far : far_) quads.push_back(far.quad);
  std::ranges::sort(quads);
  quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
  return quads;
}

double FacetCheck::farthest_in_tolerances() const {
  double farthest = tolerance_mm_;
  std::vector<SurfaceSample> samples;
  for (const Far& far : far_) {
    farthest = std::max(farthest, far.crossing_mm);
    if (far.crossing_mm == 0) samples.push_back(far.sample);
  }
  samples = evenly(samples, most_measured);
  return std::max(farthest, farthest_mm(partition_, samples, tolerance_mm_, threads_, stop_)) / tolerance_mm_;
}

}  // namespace ombre::surface

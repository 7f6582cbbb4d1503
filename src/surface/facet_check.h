// Whether facets and the borders of regions keep together within a tolerance.
#pragma once

#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "surface/contour.h"
#include "surface/crossings.h"
#include "surface/surface_distance.h"

namespace ombre::surface {

// Facets of each quad follow each other: those of quad n begin at facet begins[n]; one more entry says where the last
// ones end.
using FacetBegins = std::vector<uint32_t>;

class FacetCheck {
 public:
  FacetCheck(const Partition& partition, const ContourOptions& options, const StopFlag* stop);

  // Before the first look at facets around these crossings.
  void begin() { near_crossings_.clear(); }
  // Looks at samples of facets and at crossings, but for those that were near already. Throws Cancelled.
  void check(const RegionSurface& surface, const FacetBegins& begins, const std::vector<Crossing>& crossings);
  // As the last look said; in order.
  std::vector<uint32_t> far_quads() const;
  // At the samples, or a thousand of the far ones; 1 when all are near. Throws Cancelled.
  double farthest_in_tolerances() const;

 private:
  struct Far {
    uint32_t quad = 0;
    SurfaceSample sample;    // of a facet
    double crossing_mm = 0;  // or how far the crossing is
  };

  void check_facets(const RegionSurface& surface, const FacetBegins& begins);
  void check_crossings(const RegionSurface& surface, const FacetBegins& begins, const std::vector<Crossing>& crossings);

  const Partition& partition_;
  double tolerance_mm_, reach_mm_, spacing_mm_;
  int threads_;
  const StopFlag* stop_;
  std::unordered_set<uint64_t> near_;  // hashes of facets
  std::unordered_map<uint64_t, SurfaceSample> known_far_;
  std::vector<bool> near_crossings_;
  std::vector<Far> far_;
};

}  // namespace ombre::surface

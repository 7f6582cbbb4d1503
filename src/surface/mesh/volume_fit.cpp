#include "surface/mesh/volume_fit.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "surface/mesh/border_offsets.h"

namespace ombre::surface {
namespace {

constexpr double least_cosine = 0.5;  // least cosine between normals around a vertex of a smooth border
// A smooth border passes half-way between the vertex, which is nearest to the planes there, and the middle of the
// crossings around it. Where borders meet in a line, the border passes through the vertex.
constexpr double usual_share = 0.5, most_beside = 0.25;
constexpr double flat_enough = 1.0 / 16;  // share of the reach; below it, vertices are treated alike
constexpr double least_offset = 1e-6;     // share of the reach; smaller offsets are rounding errors

// A vertex or cluster with the facets around it.
struct Star {
  uint32_t cluster = 0;
  Vec3 middle;  // middle of the crossings; holds a sum over its cells at first
  double cells = 0;
  NormalSpread spread;
  bool parts_two = true, is_smooth = false;
  Label less = 0, greater = 0;
  Vec3 areas;          // sum of the facets' normals out of region `less`, each with a length of twice the facet's area
  double offset = 0;   // distance of the border, mm
  double missing = 0;  // its share of the volume between the facets and the border, mm3
  double volume_a_mm = 0;  // increase of the enclosed volume per mm of movement along its normal
  uint32_t sample = 0;

  Vec3 normal() const { return (1 / length(areas)) * areas; }
};

// A facet with at least one smooth corner.
struct Patch {
  std::array<uint32_t, 3> corners{};  // numbers of stars
  Vec3 areas;                         // the facet's normal, with a length of twice its area
  uint32_t sample = 0;
};

class Fitter {
 public:
  Fitter(const QuadSurface& surface, double reach_mm)
      : surface_(surface), reach_mm_(reach_mm), numbers_(surface.clusters().size(), none) {
    gather_facets();
    gather_cells();
    leave_out_lines();
    list_samples();
  }

  const std::vector<BorderSample>& samples() const { return samples_; }

  void measure(const std::vector<std::optional<double>>& offsets) {
    for (Star& star : stars_)
      if (star.is_smooth) measure(star, offsets[star.sample]);
    for (const Patch& patch : patches_)
      if (offsets[patch.sample]) share(patch, *offsets[patch.sample]);
  }

  // Calls f(cluster, new place) for each cluster that has to move.
  template <class F>
  void each_move(F f) const {
    for (const Star& star : stars_) {
      if (!star.is_smooth || star.volume_a_mm <= 0) continue;
      const double rise = std::clamp(star.missing / star.volume_a_mm, -reach_mm_, reach_mm_);
      if (std::abs(rise) >= least_offset * reach_mm_) f(star.cluster, place(star) + rise * star.normal());
    }
  }

 private:
  static constexpr uint32_t none = ~uint32_t{0};

  Vec3 place(const Star& star) const { return surface_.clusters().places()[star.cluster]; }

  uint32_t star_of(uint32_t cluster) {
    if (numbers_[cluster] == none) {
      numbers_[cluster] = static_cast<uint32_t>(stars_.size());
      stars_.emplace_back().cluster = cluster;
    }
    return numbers_[cluster];
  }

  void gather_facets() {
    for (uint32_t quad = 0; quad < surface_.quads(); ++quad) {
      const CrossedEdge& edge = surface_.crossing(quad).edge;
      const double sign = edge.from < edge.to ? 1 : -1;
      for (const Triangle& corners : surface_.triangles(quad)) {
        Patch patch{{}, sign * surface_.normal(corners)};
        for (size_t n = 0; n < 3; ++n) {
          patch.corners[n] = star_of(corners[n]);
          Star& star = stars_[patch.corners[n]];
          star.areas = star.areas + patch.areas;
          std::tie(star.less, star.greater) = std::minmax(edge.from, edge.to);
        }
        patches_.push_back(patch);
      }
    }
  }

  void gather_cells() {
    const std::vector<DualVertex>& vertices = surface_.mesh().vertices;
    for (uint32_t n = 0; n < vertices.size(); ++n) {
      const uint32_t number = numbers_[surface_.clusters().of(n)];
      if (number == none) continue;
      Star& star = stars_[number];
      star.middle = star.middle + vertices[n].planes.mean();
      ++star.cells;
      star.spread.add(vertices[n].spread);
      star.parts_two &= vertices[n].parts_two;
    }
  }

  void leave_out_lines() {
    for (Star& star : stars_) {
      star.middle = (1 / star.cells) * star.middle;
      star.is_smooth = star.parts_two && star.spread.least_cosine() >= least_cosine && length(star.areas) > 0;
    }
    std::erase_if(patches_, [&](const Patch& patch) { return length(patch.areas) == 0 || smooth_corners(patch) == 0; });
  }

  ptrdiff_t smooth_corners(const Patch& patch) const {
    return std::ranges::count_if(patch.corners, [&](uint32_t corner) { return stars_[corner].is_smooth; });
  }

  void list_samples() {
    for (Star& star : stars_)
      if (star.is_smooth) star.sample = add({place(star), star.normal(), star.less, star.greater});
    for (Patch& patch : patches_) {
      const Vec3 a = place(stars_[patch.corners[0]]), b = place(stars_[patch.corners[1]]),
                 c = place(stars_[patch.corners[2]]);
      const Star& smooth = *first_smooth(patch);
      patch.sample =
          add({(1.0 / 3) * (a + b + c), (1 / length(patch.areas)) * patch.areas, smooth.less, smooth.greater});
    }
  }

  const Star* first_smooth(const Patch& patch) const {
    for (const uint32_t corner : patch.corners)
      if (stars_[corner].is_smooth) return &stars_[corner];
    return nullptr;
  }

  uint32_t add(const BorderSample& sample) {
    samples_.push_back(sample);
    return static_cast<uint32_t>(samples_.size() - 1);
  }

  void measure(Star& star, std::optional<double> offset) const {
    star.offset = offset.value_or(0);
    const double to_middle = dot(star.middle - place(star), star.normal());
    star.is_smooth = offset && std::abs(star.offset - usual_share * to_middle) <=
                                   most_beside * std::abs(to_middle) + flat_enough * reach_mm_;
  }

  // The mean of a quadratic over a triangle is 3/4 of its value in the middle plus 1/12 of its value at each corner.
  void share(const Patch& patch, double in_the_middle) {
    const double smooth = static_cast<double>(smooth_corners(patch));
    if (smooth == 0) return;
    double offset = 0.75 * in_the_middle;
    for (const uint32_t corner : patch.corners) offset += stars_[corner].offset / 12;
    const double area = 0.5 * length(patch.areas);
    for (const uint32_t corner : patch.corners) {
      Star& star = stars_[corner];
      if (!star.is_smooth) continue;
      star.missing += offset * area / smooth;
      star.volume_a_mm += dot(patch.areas, star.normal()) / 6;
    }
  }

  const QuadSurface& surface_;
  double reach_mm_;
  std::vector<uint32_t> numbers_;  // by cluster: number of its star
  std::vector<Star> stars_;        // one for each cluster with facets
  std::vector<Patch> patches_;
  std::vector<BorderSample> samples_;
};

}  // namespace

VolumeFit::VolumeFit(QuadSurface& surface, const Partition& partition, double reach_mm, const Workers& workers)
    : from_(surface.clusters().size()) {
  Fitter fitter(surface, reach_mm);
  fitter.measure(border_offsets(partition, fitter.samples(), reach_mm, workers.threads, workers.stop));
  fitter.each_move([&](uint32_t cluster, Vec3 to) {
    from_[cluster] = surface.clusters().places()[cluster];
    surface.place(cluster, to);
  });
}

bool VolumeFit::undo(QuadSurface& surface, const std::vector<uint32_t>& quads) {
  bool moved = false;
  for (const uint32_t quad : quads)
    for (const uint32_t vertex : surface.mesh().quads[quad].corners) {
      const uint32_t cluster = surface.clusters().of(vertex);
      if (!from_[cluster]) continue;
      surface.place(cluster, *from_[cluster]);
      from_[cluster].reset();
      moved = true;
    }
  return moved;
}

}  // namespace ombre::surface

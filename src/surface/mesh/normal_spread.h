// How far the normals around a vertex lie apart, and what distances from their planes say there.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math/vec.h"

namespace ombre::surface {

class NormalSpread {
 public:
  void add(Vec3 normal) {
    if (first_ == Vec3{}) first_ = normal;
    least_cosine_ = std::min(least_cosine_, dot(first_, normal));
  }
  void add(const NormalSpread& other) {
    add(other.first_);
    least_cosine_ = std::min(least_cosine_, other.least_cosine_);
  }

  double least_cosine() const { return least_cosine_; }

  // The root of the mean square of distances to the planes may be so large, in tolerances, where `usual` is enough on
  // surfaces that are smooth or meet bluntly. In a wedge it says little of how far its edge is, in narrow ones nothing.
  double most_rms(double usual) const {
    constexpr double of_wedges = 0.15, cosine_of_wedges = -0.3, cosine_of_narrow_wedges = -0.98;
    if (least_cosine_ > cosine_of_wedges) return usual;
    const double sine_of_half = std::sqrt(std::max(0.0, (1 + least_cosine_) / 2));
    return least_cosine_ > cosine_of_narrow_wedges ? of_wedges * sine_of_half : -1;
  }

 private:
  Vec3 first_;
  double least_cosine_ = 1;  // between the first and another
};

}  // namespace ombre::surface

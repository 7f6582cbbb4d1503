// The spread of the normals around a vertex, and the limit on distances from the planes that follows from it.
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

  // Returns the greatest allowed rms distance to the planes, in tolerances; `usual` is the limit for surfaces that are
  // smooth or meet at obtuse angles. In a wedge that distance says little about how far the edge is off, and nothing in
  // a narrow wedge.
  double most_rms(double usual) const {
    constexpr double of_wedges = 0.15, cosine_of_wedges = -0.3, cosine_of_narrow_wedges = -0.98;
    if (least_cosine_ > cosine_of_wedges) return usual;
    const double sine_of_half = std::sqrt(std::max(0.0, (1 + least_cosine_) / 2));
    return least_cosine_ > cosine_of_narrow_wedges ? of_wedges * sine_of_half : -1;
  }

 private:
  Vec3 first_;
  double least_cosine_ = 1;  // least cosine between the first normal and any other
};

}  // namespace ombre::surface

// Sums of squared distances to planes, and the point where they are least.
#pragma once

#include "base/math/vec.h"

namespace ombre::surface {

// After Garland and Heckbert (1997) and Ju et al. (2002): x -> sum of (normal . (x - at))^2 over the planes.
class Quadric {
 public:
  void add(Vec3 at, Vec3 normal);  // a plane through `at`; the normal is a unit vector
  void add(const Quadric& other);
  Vec3 mean() const { return (1 / count_) * sum_; }  // of the points that were given

  struct Least {
    Vec3 at;
    double rms_mm = 0;  // from the planes
  };
  // Of all points where the sum is least, or hardly more, the one nearest to the mean.
  Least least() const;

 private:
  double at(Vec3 x) const;

  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;  // of sum of n n^T
  Vec3 linear_;                                                 // sum of n (n . p)
  double constant_ = 0;                                         // sum of (n . p)^2
  Vec3 sum_;
  double count_ = 0;
};

}  // namespace ombre::surface

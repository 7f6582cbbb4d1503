// Sums of squared distances to planes, and the point that minimizes them.
#pragma once

#include "base/math/vec.h"

namespace ombre::surface {

// The function x -> sum of (normal . (x - at))^2 over the planes (Garland and Heckbert 1997; Ju et al. 2002).
class Quadric {
 public:
  void add(Vec3 at, Vec3 normal);  // adds a plane through `at`; the normal is a unit vector
  void add(const Quadric& other);
  Vec3 mean() const { return (1 / count_) * sum_; }  // mean of the points passed to add()

  struct Least {
    Vec3 at;
    double rms_mm = 0;  // distance from the planes
  };
  // Returns the point nearest to the mean among those where the sum is minimal, or very nearly so.
  Least least() const;

 private:
  double at(Vec3 x) const;

  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;  // entries of the sum of n n^T
  Vec3 linear_;                                                 // sum of n (n . p)
  double constant_ = 0;                                         // sum of (n . p)^2
  Vec3 sum_;
  double count_ = 0;
};

}  // namespace ombre::surface

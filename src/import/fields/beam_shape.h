// One beam of a lattice, or one ball.
#pragma once

#include <array>
#include <cstdint>

#include "base/math/box.h"
#include "formats/mesh/beam_lattice.h"

namespace ombre::importing {

// A conical frustum with its caps (3MF Beam Lattice 1.2, section 2.1.1). A ball is a beam without a length.
class BeamShape {
 public:
  using Cap = formats::BeamCap;

  // Constructs a beam; the ends must differ, and the radii must be positive.
  BeamShape(Vec3 start, Vec3 end, std::array<double, 2> radii, std::array<Cap, 2> caps);
  static BeamShape ball(Vec3 centre, double radius);

  // An end of the axis.
  Vec3 end(int i) const { return ends_[i]; }
  double greatest_radius() const { return std::max(radii_[0], radii_[1]); }

  // Returns the signed distance to the surface, negative inside. It is exact outside; inside, its magnitude is at most
  // the depth.
  double distance(Vec3 p) const;

  // The convex pieces whose union is the beam; a line meets each in one interval.
  enum Piece : uint8_t { frustum, first_cap, second_cap };
  static constexpr std::array<Piece, 3> pieces{frustum, first_cap, second_cap};
  bool has(Piece piece) const;
  // Returns true only if the line of points origin + t * step is farther from the axis than the greatest radius.
  bool is_missed_by(Vec3 origin, Vec3 step) const;
  bool holds(Piece piece, Vec3 p) const;
  // Returns the interval of t in which the points origin + t * step lie within the piece, up to rounding; lo > hi if
  // there is none.
  Interval chord(Piece piece, Vec3 origin, Vec3 step) const;

 private:
  // Cylindrical coordinates of a point relative to the axis.
  struct Place {
    double along = 0, across = 0;
  };

  BeamShape() = default;
  bool is_ball() const { return length_ == 0; }
  Place place(Vec3 p) const;
  double radius_at(double along) const { return radii_[0] + slope_ * along; }
  double slant_distance(Place at) const { return (at.across - radius_at(at.along)) * slant_cosine_; }
  double frustum_distance(Place at) const;
  double depth_in_frustum(Vec3 p, Place at) const;
  double depth_in_cap(int i, Vec3 p, Place at) const;
  double beyond(int i, double along) const { return i == 0 ? -along : along - length_; }
  Interval ball_chord(int i, Vec3 origin, Vec3 step) const;
  Interval frustum_chord(Vec3 origin, Vec3 step) const;

  std::array<Vec3, 2> ends_;
  Vec3 axis_;  // unit vector
  double length_ = 0, slope_ = 0, slant_cosine_ = 1;
  std::array<double, 2> radii_{};
  std::array<Cap, 2> caps_{};
};

}  // namespace ombre::importing
